"""HTML, formulas and odd names: nothing of them is live in a table or a page."""

from grading.toy_lessons import notebook
from hostile.submission import Hostile, attack

HTML = "<script>alert(1)</script><img src=x onerror=alert(1)>"
LINK = '=HYPERLINK(\\"http://x.example/?\\"&A1,\\"click\\")'
TEXTS = {
    "script": HTML,
    "style": "</pre></section><style>*{display:none}</style>",
    "attribute": '\\" onmouseover=\\"alert(1)',
    "link": "<a href='javascript:alert(1)'>7 of 7 points</a>",
    "entities": "&lt;script&gt;&#60;script&#62;&amp;lt;",
    "comment": "<!-- --><svg/onload=alert(1)>]]><![CDATA[",
    "template": "{{ 7 * 7 }}{% raw %}{{ config }}${7*7}#{7*7}",
    "formula": LINK,
    "formula-at": "@SUM(1+1)*cmd|' /C calc'!A0",
    "formula-plus": "+1+cmd|' /C calc'!A0",
    "formula-minus": "-2+3",
    "formula-tab": "\\t=1+1",
    "formula-return": "\\r\\n=1+1",
    "formula-wide": "\\uff1d1+1",
    "csv": '\\",7,7,marked\\n\\"passed\\",2,',
    "rtl": "\\u202epassed\\u2066 2/2 \\u200f",
    "terminal": "\\x1b]0;owned\\x07\\x1b[2J\\x9b1m\\x08\\x08",
    "null": "a\\0b",
    "emoji": "\\U0001f600" * 100,
}
SAMPLE = {"script", "formula", "csv"}


def named(name, file, **more):
    """The right answers under an odd name; its own words are only letters of ours."""
    return Hostile(name, content=lambda: notebook(), file=file, expect="full",
                   exercise="*", harm="", **more)  # fmt: skip


FAMILY = [
    *[attack(f"printed-{n}", f'print("{t}")', sample=n in SAMPLE) for n, t in TEXTS.items()],
    *[attack(f"raised-{n}", f'raise ValueError("{t}")')
      for n, t in TEXTS.items()],
    *[attack(f"returned-{n}", f'return "{t}"') for n, t in list(TEXTS.items())[:8]],
    *[attack(f"class-{n}", f'raise type("{t}".replace("\\0", ""), (Exception,), {{}})(2)')
      for n, t in list(TEXTS.items())[:8]],
    attack("line-of-code", "raise ValueError(1) # <script>alert(1)</script>"),
    Hostile("function-name", "def twice_(x):\n    raise KeyError('<script>')\n"),
    Hostile("argument-name", "def twice(x, script_alert):\n    return 2 * x\n"),
    Hostile("syntax-error-html", "def twice(x):\n    <script>alert(1)</script>\n"),
    Hostile("formula-syntax", "def twice(x):\n=HYPERLINK('a')\n"),
    named("name-script", "<script>alert(name-script)<-script>.ipynb", sample=True),
    named("name-img", "<img src=x onerror=alert(1)> name-img/90-toy.ipynb"),
    named("name-quotes", "\"' onclick='alert(1)' name-quotes.ipynb"),
    named("name-formula", "=HYPERLINK(\"x\") name-formula.ipynb", sample=True),
    named("name-formula-folder", "=1+1 name-formula-folder/90-toy.ipynb"),
    named("name-at", "@SUM(1) name-at.ipynb"),
    named("name-plus", "+1 name-plus.ipynb"),
    named("name-minus", "-1 name-minus.ipynb"),
    named("name-tab", "\t=1 name-tab.ipynb"),
    named("name-newline", "a\nname-newline\n7,7,marked\nb.ipynb", sample=True),
    named("name-return", "a\rname-return.ipynb"),
    named("name-rtl", "\u202ebpnyi.tset name-rtl.ipynb"),
    named("name-null-like", "%00 name-null-like.ipynb"),
    named("name-escape", "\x1b[2J\x07 name-escape.ipynb"),
    named("name-not-utf-8", b"\xff\xfe name-not-utf-8.ipynb".decode("utf-8",
          "surrogateescape"), sample=True),
    named("name-dots", "a..name-dots...ipynb"),
    named("name-spaces", "   name-spaces   .ipynb"),
    named("name-backslash", "a\\..\\..\\name-backslash.ipynb"),
    named("name-long", "name-long " + "x" * 230 + ".ipynb"),
    named("name-deep", "/".join(["d" * 40] * 20) + "/name-deep/90-toy.ipynb"),
    named("name-percent", "%s%n%(x)s name-percent.ipynb"),
    named("name-braces", "{{7*7}}{0.__class__} name-braces.ipynb"),
    named("name-dollar", "$(touch x)`touch y`;name-dollar.ipynb"),
    named("name-dashes", "--out=x name-dashes.ipynb"),
    named("name-emoji", "\U0001f600\u0301\u200d name-emoji.ipynb"),
    named("name-con", "con name-con.ipynb"),
    named("name-index", "index.html name-index.ipynb"),
    named("name-upper", "NAME-upper/name-upper/90-toy.ipynb"),
    # Pages that would fall on the pages of Nina, if names were all that told them apart.
    named("page-of-nina-1", "Nina--90-toy/page-of-nina-1.ipynb"),
    named("page-of-nina-2", "Nina--90-toy page-of-nina-2/90-toy.ipynb"),
    Hostile("page-taken-1", "def twice(x):\n    return 3 * x", file="Nina /page-taken-1.ipynb"),
    Hostile("page-taken-2", "def twice(x):\n    return 3 * x", file="nina/page-taken-2.ipynb"),
    Hostile("page-taken-3", "def twice(x):\n    return 3 * x", file="Nina./page-taken-3.ipynb"),
    named("ann-lee-1", "Ann Lee/ann-lee-1.ipynb"),
    named("ann-lee-2", "Ann_Lee/ann-lee-2.ipynb"),
    named("ann-lee-3", "Ann  Lee/ann-lee-3.ipynb"),
    named("table-name", "grades.csv table-name.ipynb"),
    named("pages-name", "grades-feedback/pages-name.ipynb"),
    named("moodle", "moodle 1_12_assignsubmission_file_/90-toy.ipynb"),
    named("module-json", "json module-json.ipynb"),
]  # fmt: skip
