"""A server that speaks rosbridge, in front of two lamps."""

from __future__ import annotations

import base64
import json
import threading
from types import TracebackType
from typing import Any, Self

import numpy as np
from websockets.exceptions import ConnectionClosed
from websockets.sync.server import Server, ServerConnection, serve


class LampServer:
    """Action ``/light``, services ``/put_out`` and ``/reset``, topic ``/camera``.

    Args:
        secret: what it says beside whatever failed.
    """

    def __init__(self, secret: str = "") -> None:
        self._secret = secret
        self.lit: set[str] = set()
        self.seeds: list[tuple[int, str]] = []
        self.encoding = "rgb8"
        self.cancelled = 0
        self._server: Server = serve(self._speak, "127.0.0.1", 0, max_size=None)
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)

    @property
    def port(self) -> int:
        return int(self._server.socket.getsockname()[1])

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._server.shutdown()
        self._thread.join()

    def picture(self) -> np.ndarray[Any, Any]:
        picture = np.full((8, 16, 3), 40, np.uint8)
        for place, lamp in enumerate(("left", "right")):
            if lamp in self.lit:
                picture[:, 8 * place : 8 * place + 8] = (255, 200, 0)
        return picture

    def _speak(self, connection: ServerConnection) -> None:
        try:
            for text in connection:
                if "/die" in str(text):
                    return  # which closes the connection
                for answer in self._answers(json.loads(text)):
                    connection.send(json.dumps(answer))
        except ConnectionClosed:
            pass

    def _answers(self, call: dict[str, Any]) -> list[dict[str, Any]]:  # noqa: PLR0911
        match call["op"], call.get("action") or call.get("service") or call.get("topic"):
            case "subscribe", "/camera":
                return [{"op": "publish", "topic": "/camera", "msg": self._message()}] * 2
            case "send_action_goal", "/light":
                works = call["args"]["lamp"] not in self.lit
                self.lit.add(call["args"]["lamp"])
                return [_ended(call, 4 if works else 6)]
            case "send_action_goal", "/refused":
                return [{**_ended(call, 0), "result": False, "values": {"why": "no server"}}]
            case "cancel_action_goal", _:
                self.cancelled += 1
            case "call_service", "/put_out":
                works = call["args"]["lamp"] in self.lit
                self.lit.discard(call["args"]["lamp"])
                return [
                    _served(
                        call, {"success": works, "message": "" if works else f"dark{self._secret}"}
                    )
                ]
            case "call_service", "/reset":
                self.lit = set()
                self.seeds.append((call["args"]["seed"], call["args"]["scene"]))
                return [_served(call, {"success": call["args"]["seed"] >= 0})]
            case "call_service", "/broken":
                return [{**_served(call, f"no such service{self._secret}"), "result": False}]
        return []

    def _message(self) -> dict[str, Any]:
        rows = self.picture()[:, :, :: -1 if self.encoding == "bgr8" else 1]
        padded = np.pad(
            rows.reshape(8, 48), ((0, 0), (0, 4))
        )  # rows may be longer than their pixels
        data = base64.b64encode(padded.tobytes()).decode()
        shape = {"height": 8, "width": 16, "step": 52}
        return {**shape, "encoding": self.encoding, "data": data}


def _ended(call: dict[str, Any], status: int) -> dict[str, Any]:
    told = {"op": "action_result", "id": call["id"], "action": call["action"]}
    return {**told, "status": status, "result": True, "values": {"seconds": 1}}


def _served(call: dict[str, Any], values: Any) -> dict[str, Any]:
    told = {"op": "service_response", "id": call["id"], "service": call["service"]}
    return {**told, "values": values, "result": True}
