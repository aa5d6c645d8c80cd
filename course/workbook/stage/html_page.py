"""A film as one HTML file that needs no network: open it from disk, on a phone too."""

from __future__ import annotations

import html
import json

from course.workbook.stage.exhibit import Exhibit, exhibit_json
from course.workbook.stage.module import program, style
from course.workbook.stage.still import svg

_PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
:root {{ color-scheme: light dark; }}
body {{ margin: 0; padding: 12px; background: #fff; }}
@media (prefers-color-scheme: dark) {{ body {{ background: #14171c; }} }}
body > div {{ margin: auto; }}
{style}</style></head>
<body><div id="stage"></div><noscript>{still}</noscript>
<script type="application/json" id="exhibit">{exhibit}</script>
<script type="module">{program}
window.stage = new Stage(document.getElementById("stage"), JSON.parse(document.getElementById("exhibit").textContent));
</script></body></html>
"""


def page(exhibit: Exhibit, *, large: bool = False) -> str:
    """The page. Without Python behind it knobs stand still; each preset brings its film."""
    shown = exhibit_json(exhibit, large=large, films=True)
    film = exhibit.made()
    return _PAGE.format(
        title=html.escape(film.title or "film"),
        style=style(),
        still=svg(film),
        # "</" would end the script element.
        exhibit=json.dumps(shown, ensure_ascii=False).replace("</", "<\\/"),
        program=program(),
    )
