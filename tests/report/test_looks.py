"""The page in a real browser: it is drawn, and fits."""

import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from browser import BROWSER, NO_BROWSER, QUIET
from PIL import Image

from skillwrapper.report import write_report
from skillwrapper.runs.archive import RunArchive

pytestmark = pytest.mark.skipif(BROWSER is None, reason=NO_BROWSER)


def browse(folder: Path, *arguments: str) -> str:
    """Run the browser with a profile of its own and without a way to any network."""
    done = subprocess.run(
        [
            str(BROWSER),
            *QUIET,
            "--host-resolver-rules=MAP * ~NOTFOUND",
            f"--user-data-dir={folder / 'profile'}",
            *arguments,
        ],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    return done.stdout


def test_the_page_is_drawn(run: RunArchive, tmp_path: Path) -> None:
    page = write_report(run, tmp_path / "report.html")
    picture = tmp_path / "page.png"
    browse(tmp_path, "--window-size=1280,2400", f"--screenshot={picture}", page.as_uri())
    with Image.open(picture) as image:
        pixels = np.asarray(image.convert("RGB"))
    assert pixels.shape == (2400, 1280, 3)
    colours = np.unique(pixels @ np.array([1 << 16, 1 << 8, 1]))
    assert len(colours) > 1000  # text, charts and pictures, not a blank sheet
    rows_with_content = (pixels.std(axis=(1, 2)) > 1).mean()
    assert rows_with_content > 0.5


def test_pictures_are_decoded_and_nothing_runs_over_a_narrow_page(
    run: RunArchive, tmp_path: Path
) -> None:
    """A page around it measures it, as nothing in the report itself may run."""
    report = write_report(run, tmp_path / "report.html").read_text()
    measure = """<script>addEventListener('load', () => {
      const images = [...document.images];
      const bad = images.filter(i => i.complete && i.naturalWidth === 0).length;
      const all = document.documentElement;
      document.title = `images ${images.length} bad ${bad} over ${all.scrollWidth - innerWidth}`;
    })</script></body>"""
    page = tmp_path / "measured.html"
    page.write_text(report.replace("</body>", measure))
    dom = browse(tmp_path, "--window-size=500,900", "--dump-dom", page.as_uri())
    found = re.search(r"<title>images (\d+) bad (\d+) over (-?\d+)</title>", dom)
    assert found, dom[:300]
    images, bad, over = map(int, found.groups())
    assert images > 5
    assert bad == 0
    assert over <= 0
