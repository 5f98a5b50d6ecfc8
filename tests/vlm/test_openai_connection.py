"""What others have put into the environment: one sentence that names the variable, never a trace.

The kinds come from public reports on HTTP clients: SOCKS proxies without the package for them,
ports with letters, certificates that are not there, keys copied with their quotes.
"""

from __future__ import annotations

import ssl
import subprocess
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path
from threading import Thread

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scripted import ScriptedModel

from skillwrapper.embedded.server import SEEING, VlmServer
from skillwrapper.errors import ConfigurationError, ProviderError, SkillWrapperError, UserError
from skillwrapper.vlm.endpoints import Endpoint, endpoint_address
from skillwrapper.vlm.openai_connection import open_client
from skillwrapper.vlm.openai_model import OpenAIModel, OpenAISettings
from skillwrapper.vlm.protocol import ModelRequest, Role

REMOTE = "https://models.example.org/v1"
KEY = "sk-planted-4711-secret"
ASKED = ModelRequest(Role.ACT, "", "hello")


@pytest.fixture(autouse=True)
def _no_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("OPENAI_API_KEY", "OPENAI_BASE_URL", "HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY"):
        monkeypatch.delenv(name, raising=False)
        monkeypatch.delenv(name.lower(), raising=False)
    monkeypatch.delenv("SSL_CERT_FILE", raising=False)


WRONG = [
    ({"ALL_PROXY": "socks5://127.0.0.1:1080"}, "SOCKS proxy in ALL_PROXY"),
    ({"all_proxy": "socks5h://u:hunter22@127.0.0.1:1080"}, "SOCKS proxy in all_proxy"),
    ({"HTTPS_PROXY": "http://proxy:80o0"}, "HTTPS_PROXY: expected a proxy"),
    ({"HTTP_PROXY": "ftp://proxy"}, "HTTP_PROXY: expected a proxy"),
    ({"ALL_PROXY": "socks4://proxy:1"}, "ALL_PROXY: expected a proxy"),
    ({"HTTPS_PROXY": "http://"}, "HTTPS_PROXY: expected a proxy"),
    ({"HTTPS_PROXY": "http://[::1"}, "HTTPS_PROXY: expected a proxy"),
    ({"SSL_CERT_FILE": "/nowhere/ca.pem"}, "SSL_CERT_FILE: expected a file with certificates"),
    ({"SSL_CERT_FILE": "/etc/passwd"}, "/etc/passwd', which holds none"),
    ({"HTTPS_PROXY": "http://pro\x01xy"}, "HTTPS_PROXY: expected a proxy"),
    ({"SSL_CERT_DIR": "/nowhere"}, "SSL_CERT_DIR: expected a folder"),
    ({"OPENAI_API_KEY": "\u201csk-abcdef\u201d"}, "OPENAI_API_KEY: character 1 of 11"),
    ({"OPENAI_API_KEY": '"sk-abcdef"'}, "without quotes"),
    ({"OPENAI_API_KEY": "sk-abc def"}, "a blank or line end"),
    ({"OPENAI_API_KEY": "sk-abc\ndef"}, "a blank or line end"),
    ({"OPENAI_API_KEY": "sk-abc\x00def"}, "a control character"),
    ({"OPENAI_API_KEY": "sk-abc\u200b"}, "OPENAI_API_KEY: character 7"),
    ({"OPENAI_ORG_ID": "org-\u00e9"}, "OPENAI_ORG_ID"),
    ({"OPENAI_PROJECT_ID": "a\nb"}, "OPENAI_PROJECT_ID"),
]


@pytest.mark.parametrize(("variables", "said"), WRONG)
def test_every_variable_is_named(variables: dict[str, str], said: str) -> None:
    with pytest.raises(UserError) as caught:
        Endpoint.find("m", REMOTE, variables)
    assert said in str(caught.value)
    assert "hunter22" not in str(caught.value)
    assert "abc" not in str(caught.value)


@pytest.mark.parametrize(
    "url",
    [
        "localhost:8000/v1",
        "http://localhost:80o0/v1",
        "http://localhost:99999/v1",
        "http://:8000/v1",
        "https://",
        "ftp://host/v1",
        "http://host/v1 ",
        "http://h\u00f6st/v1",
        "\u201chttp://host/v1\u201d",
        "http://[::1/v1",
        "http://host/v1?api_key=hunter22",
        "http://user:hunter22@host:80o0/v1",
        "http://host/v1#x",
    ],
)
@pytest.mark.parametrize("by_variable", [False, True])
def test_addresses_that_are_none(url: str, by_variable: bool) -> None:
    variables = {"OPENAI_BASE_URL": url} if by_variable else {}
    if by_variable and url.strip() != url:
        return  # blanks around a variable's value do no harm
    with pytest.raises(ConfigurationError) as caught:
        Endpoint.find("m", None if by_variable else url, variables)
    assert str(caught.value).startswith("'OPENAI_BASE_URL'" if by_variable else "'base-url'")
    assert "hunter22" not in str(caught.value)


@given(st.text(max_size=40), st.sampled_from(["OPENAI_API_KEY", "HTTPS_PROXY", "OPENAI_BASE_URL"]))
def test_whatever_a_variable_holds_it_is_used_or_refused(value: str, name: str) -> None:
    said = ""
    try:
        endpoint = Endpoint.find("m", None, {"OPENAI_API_KEY": "x", name: value})
        open_client(endpoint, 1.0).close()
    except SkillWrapperError as error:
        said = str(error)
    assert len(said.splitlines()) <= 1


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "127.8.9.1", "[::1]", "a.localhost"])
def test_this_machine_is_asked_without_a_proxy(host: str) -> None:
    variables = {"ALL_PROXY": "socks5://127.0.0.1:1", "SSL_CERT_FILE": "/nowhere"}
    assert Endpoint.find("m", f"http://{host}:8000/v1", variables).is_local
    assert not Endpoint.find("m", REMOTE, {}).is_local


def test_a_proxy_that_nobody_serves_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HTTPS_PROXY", "http://127.0.0.1:1")
    monkeypatch.setenv("NO_PROXY", "")
    with pytest.raises(ProviderError, match=r"nobody answers .*the proxy that HTTPS_PROXY names"):
        OpenAIModel(OpenAISettings("m", REMOTE)).complete(ASKED)


def test_a_call_to_this_machine_passes_by_every_proxy(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("ALL_PROXY", "HTTP_PROXY", "http_proxy"):
        monkeypatch.setenv(name, "http://127.0.0.1:1")
    monkeypatch.setenv("SSL_CERT_FILE", "/nowhere")
    with VlmServer(ScriptedModel(lambda _: "hi")) as server:
        model = OpenAIModel(OpenAISettings(SEEING, base_url=server.url))
        assert model.complete(ASKED).text == "hi"
        model.close()


def test_blanks_around_a_key_do_no_harm() -> None:
    assert Endpoint.find("m", REMOTE, {"OPENAI_API_KEY": f" {KEY}\n"}).key == KEY


def test_credentials_in_an_address_are_used_and_never_shown() -> None:
    endpoint = Endpoint.find("m", "http://rob:hunt%40er22@127.0.0.1:8000/v1", {})
    assert endpoint.url == "http://127.0.0.1:8000/v1"
    assert endpoint.login == ("rob", "hunt@er22")
    assert "hunt" not in repr(endpoint)
    assert "hunt" not in endpoint.redactor.redact("http://rob:hunt%40er22@h hunt@er22 hunt%40er22")


def test_where_nothing_is_named_openai_is_asked() -> None:
    assert endpoint_address(None, {"OPENAI_BASE_URL": " "}) == "https://api.openai.com/v1"


class _Page(BaseHTTPRequestHandler):
    def do_POST(self) -> None:
        self.send_response(200)
        self.end_headers()

    def log_message(self, format: str, *args: object) -> None:
        pass


@pytest.fixture(scope="module")
def tls(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, Path]]:
    """A server with a certificate that nobody has signed but itself."""
    folder = tmp_path_factory.mktemp("tls")
    certificate, key = folder / "cert.pem", folder / "key.pem"
    line = ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256"]
    line += ["-nodes", "-days", "2", "-subj", "/CN=localhost", "-addext"]
    line += ["subjectAltName=DNS:localhost,IP:127.0.0.1"]
    try:
        made = subprocess.run(
            [*line, "-keyout", str(key), "-out", str(certificate)], capture_output=True, check=False
        )
    except FileNotFoundError:
        pytest.skip("openssl is not installed")
    assert made.returncode == 0, made.stderr
    server = HTTPServer(("127.0.0.1", 0), _Page)
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(certificate, key)
    server.socket = context.wrap_socket(server.socket, server_side=True)
    server.handle_error = lambda request, address: None  # type: ignore[method-assign]
    thread = Thread(target=server.serve_forever, daemon=True)
    thread.start()
    yield f"https://127.0.0.1:{server.server_address[1]}/v1", certificate
    server.shutdown()
    thread.join()
    server.server_close()


def test_a_self_signed_certificate_is_called_so(tls: tuple[str, Path]) -> None:
    model = OpenAIModel(OpenAISettings("m", base_url=tls[0]))
    with pytest.raises(ConfigurationError, match="self-signed; set SSL_CERT_FILE"):
        model.complete(ASKED)
    model.close()


def test_a_certificate_that_is_trusted_is_no_hindrance(
    tls: tuple[str, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SSL_CERT_FILE", str(tls[1]))
    model = OpenAIModel(OpenAISettings("m", base_url=tls[0]))
    with pytest.raises(ProviderError, match="sent nothing"):
        model.complete(ASKED)
    model.close()


def test_a_file_that_holds_no_certificate(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "ca.pem").write_text("nothing")
    monkeypatch.setenv("SSL_CERT_FILE", str(tmp_path / "ca.pem"))
    with pytest.raises(ConfigurationError, match="certificates"):
        OpenAIModel(OpenAISettings("m", base_url=REMOTE))


def test_tls_where_http_is_spoken() -> None:
    with VlmServer(ScriptedModel(lambda _: "hi")) as server:
        model = OpenAIModel(OpenAISettings("m", base_url=server.url.replace("http:", "https:")))
        with pytest.raises(SkillWrapperError, match=r"http://|broke"):
            model.complete(ASKED)
        model.close()
