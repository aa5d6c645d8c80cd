"""Make the README's pictures from a real lesson in a real browser: ``python tests/browser/make_pictures.py``."""

import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))

from browser.session import Lab, checkout, free_port, page, served  # noqa: E402

PICTURES = ROOT / "docs" / "pictures"
WRONG = """\
def impulse_central(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
    closing = np.sum((velocity_2 - velocity_1) * normal, axis=-1)
    impulse = restitution * closing / (1 / mass_1 + 1 / mass_2)
    return np.where(closing > 0, impulse, 0.0)


check(impulse_central)"""


def main() -> None:
    """Open lesson 10 as handed out, run it, and take the three pictures."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    root = checkout(Path(tempfile.mkdtemp(prefix="course-pictures-")))
    with (
        served(
            ["open", "10", "--no-browser", "--port", str(free_port())], root
        ) as address,
        page(1200, 860) as opened,
    ):
        lab = Lab(opened, address)
        lab.run_all()
        lab.cell("plots.blocks_and_wall()")
        for _ in range(
            3
        ):  # cells above are measured only as they come into view, which moves the page once more
            opened.evaluate(
                "document.querySelectorAll('.jp-NotebookPanel *').forEach(e => { e.scrollTop = 0 })"
            )
            opened.wait_for_timeout(700)
        opened.screenshot(path=PICTURES / "lesson.png")
        cell = lab.write_and_run("def impulse_central", WRONG)
        cell.scroll_into_view_if_needed()
        opened.wait_for_timeout(500)
        cell.screenshot(path=PICTURES / "check.png")
        chart = lab.cell('by="count", tolerance').locator(".jp-OutputArea-child").first
        chart.scroll_into_view_if_needed()
        opened.wait_for_timeout(500)
        chart.screenshot(path=PICTURES / "chart.png")


if __name__ == "__main__":
    main()
