"""The page: by plain requests, and in a real browser."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from urllib.error import HTTPError
from urllib.parse import urlencode, urlsplit
from urllib.request import HTTPRedirectHandler, OpenerDirector, ProxyHandler, Request, build_opener

import pytest
from browser import BROWSER, NO_BROWSER, browsing
from outside_links import parse

from skillwrapper.review.server import ReviewServer
from skillwrapper.review.session import Review
from skillwrapper.runs.archive import RunArchive


class Stay(HTTPRedirectHandler):
    def redirect_request(self, *arguments: object) -> None:
        return None


@pytest.fixture
def opener() -> OpenerDirector:
    return build_opener(ProxyHandler({}), Stay)


@pytest.fixture
def server(run: RunArchive) -> Iterator[ReviewServer]:
    with ReviewServer(Review(run)) as serving:
        yield serving


def fetch(opener: OpenerDirector, request: str | Request) -> tuple[int, bytes, str]:
    try:
        with opener.open(request, timeout=30) as reply:
            return reply.status, reply.read(), reply.headers.get("Location", "")
    except HTTPError as error:
        with error:
            return error.code, error.read(), error.headers.get("Location", "")


def post(server: ReviewServer, form: dict[str, str]) -> Request:
    return Request(server.url.replace("/?", "/correct?"), urlencode(form).encode())


def test_the_page_needs_nothing_from_elsewhere(
    server: ReviewServer, opener: OpenerDirector
) -> None:
    status, body, _ = fetch(opener, server.url)
    page = parse(body.decode())
    assert status == 200
    assert "script" not in page.tags
    assert all(f.startswith("<a ") or "'/" in f for f in page.found)
    token = urlsplit(server.url).query
    picture = re.search(r"/picture/\w{64}\.png\?token=[\w%-]+", body.decode())
    assert picture
    assert token in picture[0]
    status, png, _ = fetch(opener, server.url.split("/?")[0] + picture[0])
    assert (status, png[:4]) == (200, b"\x89PNG")


def test_only_who_has_the_address_gets_in(server: ReviewServer, opener: OpenerDirector) -> None:
    assert server.url.startswith("http://127.0.0.1:")
    plain = server.url.split("/?")[0]
    for url in (plain, f"{plain}/?token=x", f"{plain}/?token=%C3%A9", f"{plain}/picture/x.png"):
        assert fetch(opener, url)[0] == 403
    elsewhere = Request(server.url, headers={"Host": "evil.example"})  # another name for us
    assert fetch(opener, elsewhere)[0] == 403
    forged = Request(f"{plain}/correct", urlencode({"kind": "reject"}).encode())
    assert fetch(opener, forged)[0] == 403
    for path in ("/picture/..%2Fconfig.yaml", "/picture/" + "0" * 64 + ".png", "/other"):
        assert fetch(opener, server.url.replace("/?", f"{path}?"))[0] == 404


def test_a_correction_is_learned_from_before_the_next_page(
    server: ReviewServer, opener: OpenerDirector, run: RunArchive
) -> None:
    name = run.latest().model.predicates[0].name
    form = {"kind": "rename", "predicate": name, "to": "my_name", "at": "predicates"}
    status, _, location = fetch(opener, post(server, form))
    assert status == 303
    assert location.endswith("#predicates")
    assert "my_name" in fetch(opener, server.url)[1].decode()
    assert run.latest().model.predicates[0].name == "my_name"
    assert "my_name" in (run.layout.model / "domain.pddl").read_text()


def test_mistakes_are_said_on_the_page(server: ReviewServer, opener: OpenerDirector) -> None:
    status, body, _ = fetch(opener, post(server, {"kind": "reject", "predicate": "<b>"}))
    assert status == 422
    assert "unknown predicate &#39;&lt;b&gt;&#39;" in body.decode()
    assert fetch(opener, server.url.replace("page=", "") + "&page=junk")[0] == 200
    huge = post(server, {"kind": "x" * 10**5})
    assert fetch(opener, huge)[0] == 404


@pytest.mark.skipif(BROWSER is None, reason=NO_BROWSER)
def test_in_a_browser(server: ReviewServer, run: RunArchive, tmp_path: Path) -> None:
    """A real browser: only it knows whether forms and policies let a person work."""
    with browsing(tmp_path) as page:
        page.open(server.url)
        assert page.value("[...document.images].every(i => i.naturalWidth > 0)")
        assert page.value("document.documentElement.scrollWidth <= innerWidth")
        label = "document.querySelector('.review .label')"
        atom = page.value(f"{label}.querySelector('[name=atom]').value")
        before = page.value(f"{label}.querySelector('[aria-pressed=true]').textContent")
        page.value("document.querySelectorAll('details').forEach(d => d.open = true)")
        page.submit(f"{label}.querySelector('[value=unsure]')")
        page.screenshot(tmp_path / "page.png")
        assert page.value("document.querySelector('.tiles').textContent").count("corrections")
    (kept,) = run.corrections()
    assert kept.root.kind == "label"
    assert (kept.root.atom, kept.root.value) == (atom, None)
    assert str(kept.root.read).lower() == before
    assert (tmp_path / "page.png").stat().st_size > 10_000
