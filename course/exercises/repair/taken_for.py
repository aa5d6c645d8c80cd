"""Changes of an expression that leave it as long or make it shorter: something too many, or taken for another."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from itertools import combinations, permutations

from course.exercises.repair.places import Code, Place, is_quantity, name_of_call

Change = tuple[str, str]
#: Functions that are easily taken for one another.
FUNCTIONS = {
    "sin": "cos tan", "cos": "sin", "tan": "sin cos", "minimum": "maximum", "maximum": "minimum", "min": "max",
    "max": "min sum mean", "mean": "sum max", "sum": "max cumsum prod mean", "cumsum": "sum cumprod", "prod": "sum",
    "any": "all", "all": "any", "argmax": "argmin", "argmin": "argmax", "zeros": "ones", "ones": "zeros",
    "floor": "ceil", "ceil": "floor", "outer": "cross", "sinh": "sin", "exp": "log", "log": "exp", "square": "sqrt",
    "sqrt": "square", "arcsin": "arccos", "arccos": "arcsin", "degrees": "radians", "radians": "degrees",
    "remove": "append", "append": "remove", "pinv": "inv", "det": "trace", "floor_divide": "divide",
}  # fmt: skip
OVER_AXES = frozenset("sum norm max min mean cumsum prod any all argmax argmin".split())
#: Calls that are no step of a calculation: left out, nothing remains.
NO_STEP = frozenset("range zeros ones empty len append remove Variable reshape".split())
SIGNS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.MatMult: "@"}


def shorter(code: Code, place: Place) -> Iterator[Change]:
    """The expression with one part left out."""
    node, s = place.node, code.closed
    if isinstance(node, ast.BinOp):
        left, right = s(node.left), s(node.right)
        if isinstance(node.op, (ast.Add, ast.Sub)):
            yield "a term too many", left
            yield (
                "a term too many",
                right if isinstance(node.op, ast.Add) else f"-{right}",
            )
        elif isinstance(node.op, ast.Mult):
            yield "a factor too many", left
            yield "a factor too many", right
        elif isinstance(node.op, ast.MatMult):
            yield "a matrix too many", left
            yield "a matrix too many", right
        elif isinstance(node.op, (ast.Div, ast.FloorDiv)):
            yield "a divisor too many", left
            if isinstance(node.op, ast.Div) and left != "1":
                yield "a factor too many", f"1 / {right}"
        elif isinstance(node.op, ast.Pow):
            yield "a power too many", left
        elif isinstance(node.op, (ast.BitAnd, ast.BitOr)):
            yield "a condition too many", left
            yield "a condition too many", right
    elif isinstance(node, ast.BoolOp):
        for some in range(len(node.values)):
            kept = [s(v) for i, v in enumerate(node.values) if i != some]
            word = " and " if isinstance(node.op, ast.And) else " or "
            yield "a condition too many", word.join(kept)
    elif isinstance(node, ast.UnaryOp):
        turned = isinstance(node.op, (ast.Not, ast.Invert))
        yield ("a condition turned round" if turned else "a sign"), s(node.operand)
    elif isinstance(node, ast.IfExp):
        yield "a condition too many", s(node.body)
        yield "a condition too many", s(node.orelse)
        yield (
            "the two branches exchanged",
            f"{s(node.orelse)} if {s(node.test)} else {s(node.body)}",
        )
    elif isinstance(node, (ast.List, ast.Tuple)) and len(node.elts) > 1:
        if (
            not isinstance(place.parent, (ast.Return, ast.Subscript))
            and place.role != "args"
        ):
            yield from _without_entries(code, node)
    elif isinstance(node, ast.Subscript):
        yield from _without_index(code, node)
    elif isinstance(node, ast.Attribute) and node.attr == "T":
        yield "a transpose too many", s(node.value)
        yield (
            ".T, which turns all axes of a batch round",
            f"np.swapaxes({code.text(node.value)}, -1, -2)",
        )
    elif isinstance(node, ast.Call):
        yield from _without_call(code, node)


def _without_entries(code: Code, node: ast.List | ast.Tuple) -> Iterator[Change]:
    ends = "[]" if isinstance(node, ast.List) else "()"
    for some in range(len(node.elts)):
        kept = [code.text(e) for i, e in enumerate(node.elts) if i != some]
        yield "an entry too many", f"{ends[0]}{', '.join(kept)},{ends[1]}"


def _without_index(code: Code, node: ast.Subscript) -> Iterator[Change]:
    inside = node.slice
    parts = inside.elts if isinstance(inside, ast.Tuple) else [inside]
    value = code.closed(node.value)
    none = [p for p in parts if isinstance(p, ast.Constant) and p.value is None]
    if none:
        yield "an axis too many", value
    elif any(isinstance(p, ast.Slice) for p in parts):
        yield "a slice too many", value
        kept = [code.text(p) for p in parts if not isinstance(p, ast.Slice)]
        if kept:
            yield "a slice too many", f"{value}[{', '.join(kept)}]"


def _without_call(code: Code, node: ast.Call) -> Iterator[Change]:
    name = name_of_call(node)
    if name not in NO_STEP:
        for argument in node.args:
            if not isinstance(argument, (ast.Starred, ast.GeneratorExp)):
                yield f"{name}() too many", code.closed(argument)
    if isinstance(node.func, ast.Attribute) and not node.args:
        yield f"{name}() too many", code.closed(node.func.value)
    for some, keyword in enumerate(node.keywords):
        if keyword.arg in ("axis", "keepdims", "degrees"):
            kept = [k for i, k in enumerate(node.keywords) if i != some]
            yield f"{keyword.arg}= too many", call_text(code, node, keywords=kept)


def call_text(
    code: Code,
    node: ast.Call,
    *,
    function: str = "",
    arguments: list[str] | None = None,
    keywords: list[ast.keyword] | None = None,
    more: str = "",
) -> str:
    """A call with another function, other arguments or keywords."""
    given = [code.text(a) for a in node.args] if arguments is None else arguments
    kept = node.keywords if keywords is None else keywords
    given = given + [
        f"{k.arg}={code.text(k.value)}" if k.arg else f"**{code.text(k.value)}"
        for k in kept
    ]
    return f"{function or code.text(node.func)}({', '.join(given + ([more] if more else []))})"


def other(code: Code, place: Place) -> Iterator[Change]:
    """The expression with one part in another place, or taken for another of its kind."""
    node = place.node
    if isinstance(node, ast.BinOp):
        yield from _other_operation(code, node)
        yield from _other_brackets(code, node)
        if _is_sum(node):
            yield from _terms_into_brackets(code, node)
        if not isinstance(place.parent, ast.BinOp) or not _is_product(place.parent):
            yield from _other_side(code, node)
    elif isinstance(node, ast.Call):
        yield from _other_call(code, node)
        yield from _inside_out(code, node)
    elif isinstance(node, ast.Compare) and len(node.ops) == 1:
        yield from _other_comparison(code, node)
    elif isinstance(node, ast.BoolOp):
        word = " or " if isinstance(node.op, ast.And) else " and "
        yield "and / or", word.join(map(code.closed, node.values))
    elif (
        isinstance(node, ast.Tuple)
        and isinstance(place.parent, ast.Return)
        and len(node.elts) < 5
    ):
        texts = [code.text(e) for e in node.elts]
        for order in permutations(texts):
            if list(order) != texts:
                yield "the order of the results", ", ".join(order)
    if is_quantity(place) and not isinstance(node, (ast.Tuple, ast.List, ast.Constant)):
        if name_of_call(node) not in NO_STEP:
            yield "a sign", f"-{code.closed(node)}"


def _other_operation(code: Code, node: ast.BinOp) -> Iterator[Change]:
    left, right, op = code.closed(node.left), code.closed(node.right), node.op
    if isinstance(op, (ast.Add, ast.Sub)):
        yield (
            "the sign of a term",
            f"{left} {'-' if isinstance(op, ast.Add) else '+'} {right}",
        )
        yield (
            (
                "the sign of a term"
                if isinstance(op, ast.Add)
                else "a difference turned round"
            ),
            f"{right} - {left}",
        )
        yield f"{SIGNS[type(op)]} where * belongs", f"{left} * {right}"
    elif isinstance(op, ast.Mult):
        yield "* where / belongs", f"{left} / {right}"
        yield "* where / belongs", f"{right} / {left}"
        yield "* where + belongs", f"{left} + {right}"
        yield "* where - belongs", f"{left} - {right}"
        yield "* where - belongs", f"{right} - {left}"
        yield "* where @ belongs", f"{left} @ {right}"
        yield "* where a cross product belongs", f"np.cross({left}, {right})"
        yield "* where a dot product belongs", dot(left, right)
        yield "* where ** belongs", f"{left} ** {right}"
    elif isinstance(op, ast.Div):
        yield "/ where * belongs", f"{left} * {right}"
        yield "a quotient upside down", f"{right} / {left}"
    elif isinstance(op, ast.FloorDiv):
        yield "// where / belongs", f"{left} / {right}"
    elif isinstance(op, ast.MatMult):
        yield "the order of a product", f"{right} @ {left}"
        yield "@ of a matrix and a batch of vectors", times(left, right)
        yield "@ where a dot product belongs", dot(left, right)
        yield "@ where * belongs", f"{left} * {right}"
    elif isinstance(op, ast.Pow):
        yield from _other_factor(code, node)
        yield "the sign of a power", f"{left} ** -{right}"
        yield "** where * belongs", f"{left} * {right}"
    elif isinstance(op, (ast.BitAnd, ast.BitOr)):
        yield "& / |", f"{left} {'|' if isinstance(op, ast.BitAnd) else '&'} {right}"


def _other_factor(code: Code, node: ast.BinOp) -> Iterator[Change]:
    """sin(x)**2 as sin(x) cos(x)."""
    name = name_of_call(node.left)
    if isinstance(node.left, ast.Call) and code.text(node.right) == "2":
        whole = code.text(node.left.func)
        for instead in FUNCTIONS.get(name, "").split():
            function = whole[: len(whole) - len(name)] + instead
            second = call_text(code, node.left, function=function)
            kind = f"a square of {name}() where one factor is {instead}()"
            yield kind, f"{code.text(node.left)} * {second}"


def dot(left: str, right: str, kept: bool = False) -> str:
    """The dot product of two vectors, or of each pair of a batch."""
    return f"np.sum({left} * {right}, axis=-1{', keepdims=True' if kept else ''})"


def times(matrix: str, vector: str) -> str:
    """A matrix times a vector, or each of a batch."""
    return f"({matrix} @ np.asarray({vector})[..., None])[..., 0]"


def solved(matrix: str, vector: str) -> str:
    """The vector that a matrix takes to this one, or each of a batch."""
    return f"np.linalg.solve({matrix}, np.asarray({vector})[..., None])[..., 0]"


def _is_product(node: ast.BinOp) -> bool:
    return isinstance(node.op, (ast.Mult, ast.Div))


def _is_sum(node: ast.AST) -> bool:
    return isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub))


def _other_brackets(code: Code, node: ast.BinOp) -> Iterator[Change]:
    """a * (b + c) as a * b + c and the like, and the other way round."""
    s, left, right = code.closed, node.left, node.right
    sign = SIGNS.get(type(node.op))
    if sign is None:
        return
    if _is_product(node) or sign == "@":
        if _is_sum(right) and isinstance(right, ast.BinOp):
            inner = SIGNS[type(right.op)]
            yield (
                "brackets",
                f"{s(left)} {sign} {s(right.left)} {inner} {s(right.right)}",
            )
            yield (
                "brackets",
                f"{s(right.left)} {inner} {s(left)} {sign} {s(right.right)}",
            )
        if _is_sum(left) and isinstance(left, ast.BinOp):
            inner = SIGNS[type(left.op)]
            yield (
                "brackets",
                f"{s(left.left)} {sign} {s(right)} {inner} {s(left.right)}",
            )
            yield (
                "brackets",
                f"{s(left.left)} {inner} {s(left.right)} {sign} {s(right)}",
            )
    for one, two, first in ((left, right, True), (right, left, False)):

        def joined(x: str, first: bool = first, two: ast.expr = two) -> str:
            return f"({x} {sign} {s(two)})" if first else f"({s(two)} {sign} {x})"

        if (
            _is_sum(node)
            and isinstance(one, ast.BinOp)
            and type(one.op) in SIGNS
            and not _is_sum(one)
        ):
            inner = SIGNS[type(one.op)]
            yield "brackets", f"{s(one.left)} {inner} {joined(s(one.right))}"
            yield "brackets", f"{joined(s(one.left))} {inner} {s(one.right)}"
        if (
            isinstance(one, ast.BinOp)
            and isinstance(one.op, ast.Pow)
            and _is_product(node)
        ):
            yield "brackets", f"{joined(s(one.left))} ** {s(one.right)}"
        if isinstance(one, ast.Call):
            texts = [code.text(a) for a in one.args]
            for i, argument in enumerate(one.args):
                if not isinstance(argument, (ast.Starred, ast.Tuple)):
                    changed = [*texts[:i], joined(s(argument)), *texts[i + 1 :]]
                    yield "brackets", call_text(code, one, arguments=changed)
    if (
        isinstance(left, ast.Call)
        and isinstance(right, ast.Call)
        and left.args
        and right.args
    ):
        if code.text(left.func) == code.text(right.func):
            inside = f"{s(left.args[0])} {sign} {s(right.args[0])}"
            texts = [code.text(a) for a in left.args[1:]]
            yield (
                "the order of two steps",
                call_text(code, left, arguments=[inside, *texts]),
            )


def _terms_into_brackets(code: Code, node: ast.BinOp) -> Iterator[Change]:
    """a / b + c + d as a / (b + c + d)."""
    terms: list[tuple[str, ast.expr]] = []

    def collect(part: ast.expr, sign: str) -> None:
        if _is_sum(part) and isinstance(part, ast.BinOp):
            collect(part.left, sign)
            turned = isinstance(part.op, ast.Sub)
            collect(part.right, {"+": "-", "-": "+"}[sign] if turned else sign)
        else:
            terms.append((sign, part))

    collect(node, "+")
    for i, (sign, term) in enumerate(terms if len(terms) > 2 else ()):
        if isinstance(term, ast.BinOp) and _is_product(term):
            rest = [
                f" {s} {code.closed(t)}" for k, (s, t) in enumerate(terms) if k != i
            ]
            inside = f"({code.closed(term.right)}{''.join(rest)})"
            yield (
                "brackets",
                f"{sign}{code.closed(term.left)} {SIGNS[type(term.op)]} {inside}",
            )


def _other_side(code: Code, node: ast.BinOp) -> Iterator[Change]:
    """A product with some factors on the other side of the bar, or two calls in it made one."""
    factors: list[tuple[ast.expr, bool]] = []

    def collect(part: ast.expr, above: bool) -> None:
        if isinstance(part, ast.BinOp) and _is_product(part):
            collect(part.left, above)
            collect(part.right, above == isinstance(part.op, ast.Mult))
        else:
            factors.append((part, above))

    collect(node, True)
    if not _is_product(node) or not 2 < len(factors) <= 6:
        return
    s = code.closed
    for size in (1, 2, 3):
        for some in combinations(range(len(factors)), size):
            parts = [
                (s(f), above ^ (i in some)) for i, (f, above) in enumerate(factors)
            ]
            yield "a quotient upside down", product(parts)
    for i, j in combinations(range(len(factors)), 2):
        one, two = factors[i][0], factors[j][0]
        if (
            isinstance(one, ast.Call)
            and isinstance(two, ast.Call)
            and len(one.args) == len(two.args) == 1
        ):
            if (
                code.text(one.func) == code.text(two.func)
                and factors[i][1]
                and factors[j][1]
            ):
                inside = [f"{s(one.args[0])} * {s(two.args[0])}"]
                rest = [
                    (s(f), up) for k, (f, up) in enumerate(factors) if k not in (i, j)
                ]
                yield (
                    "the order of two steps",
                    product([(call_text(code, one, arguments=inside), True), *rest]),
                )


def product(parts: list[tuple[str, bool]]) -> str:
    """Factors above and below the bar as one product."""
    return "1.0" + "".join(f" {'*' if above else '/'} {text}" for text, above in parts)


def _other_call(code: Code, node: ast.Call) -> Iterator[Change]:
    name, texts = name_of_call(node), [code.text(a) for a in node.args]
    for i, j in combinations(range(len(texts)), 2):
        swapped = list(texts)
        swapped[i], swapped[j] = texts[j], texts[i]
        yield (
            f"the order of the arguments of {name}()",
            call_text(code, node, arguments=swapped),
        )
    for instead in FUNCTIONS.get(name, "").split():
        whole = code.text(node.func)
        function = whole[: len(whole) - len(name)] + instead
        yield (
            f"{name}() where {instead}() belongs",
            call_text(code, node, function=function),
        )
    if name in OVER_AXES and texts:
        yield from _other_axis(code, node)
    if name == "norm" and texts:
        yield "norm() where sum() belongs", call_text(code, node, function="np.sum")
        yield (
            "norm() where the square belongs",
            f"np.sum({code.closed(node.args[0])} ** 2, axis=-1)",
        )
        inner = node.args[0]
        if (
            isinstance(inner, ast.Call)
            and name_of_call(inner) == "cross"
            and len(inner.args) > 1
        ):
            yield (
                "the size of a cross product where a dot product belongs",
                dot(*map(code.closed, inner.args[:2])),
            )
    if name in ("cross", "dot", "inner", "vdot", "matmul") and len(texts) == 2:
        left, right = map(code.closed, node.args)
        yield f"{name}() where the dot product of vectors belongs", dot(left, right)
        yield f"{name}() of a matrix and a batch of vectors", times(left, right)
        yield f"{name}() where * belongs", f"{left} * {right}"
        if name != "cross":
            yield (
                f"{name}() where a cross product belongs",
                f"np.cross({left}, {right})",
            )
    if name == "solve" and len(texts) == 2:
        yield "solve() where @ belongs", " @ ".join(map(code.closed, node.args))
        yield "solve() of a batch of vectors", solved(*texts)
    if name == "from_euler" and len(texts) == 2:
        yield (
            "from_euler() where from_rotvec() belongs",
            f"Rotation.from_rotvec({texts[1]})",
        )
    if name in ("swapaxes", "moveaxis", "transpose") and texts:
        yield "the axes of a batch", f"np.swapaxes({texts[0]}, -1, -2)"
    if name == "reshape" and texts:
        inner = (
            texts[0]
            if len(texts) > 1 and texts[0] != "-1"
            else code.text(node.func)[: -len(".reshape")]
        )
        yield "a new shape where a new axis belongs", f"np.asarray({inner})[..., None]"
        if len(texts) == 2 and isinstance(node.func, ast.Attribute):
            turned = f"{code.closed(node.func.value)}.reshape({texts[1]}, {texts[0]}).T"
            yield "reshape() where a transpose belongs", turned


def _other_axis(code: Code, node: ast.Call) -> Iterator[Change]:
    name = name_of_call(node)
    named = next((k for k in node.keywords if k.arg == "axis"), None)
    if named is None:
        if len(node.args) == 1:
            yield f"{name}() without axis=-1", call_text(code, node, more="axis=-1")
            if name not in ("cumsum", "argmax", "argmin"):
                yield (
                    f"{name}() without axis=-1",
                    call_text(code, node, more="axis=-1, keepdims=True"),
                )
        return
    kept = [k for k in node.keywords if k is not named]
    for axis in ("-1", "0", "-2", "1"):
        if code.text(named.value) != axis:
            yield "the axis", call_text(code, node, keywords=kept, more=f"axis={axis}")
    if not any(k.arg == "keepdims" for k in node.keywords):
        yield "keepdims=True missing", call_text(code, node, more="keepdims=True")


def _inside_out(code: Code, node: ast.Call) -> Iterator[Change]:
    """f(a * b) as a * f(b), f(a + b) as f(a) + b."""
    texts = [code.text(a) for a in node.args]
    if name_of_call(node) in NO_STEP:
        return
    for i, argument in enumerate(node.args):
        if isinstance(argument, ast.BinOp) and type(argument.op) in SIGNS:
            sign = SIGNS[type(argument.op)]
            left, right = code.closed(argument.left), code.closed(argument.right)
            first = call_text(code, node, arguments=[*texts[:i], left, *texts[i + 1 :]])
            last = call_text(code, node, arguments=[*texts[:i], right, *texts[i + 1 :]])
            yield "brackets", f"{first} {sign} {right}"
            yield "brackets", f"{left} {sign} {last}"
            yield "the order of two steps", f"{first} {sign} {last}"


def _other_comparison(code: Code, node: ast.Compare) -> Iterator[Change]:
    signs = {
        ast.Lt: "<",
        ast.LtE: "<=",
        ast.Gt: ">",
        ast.GtE: ">=",
        ast.Eq: "==",
        ast.NotEq: "!=",
    }
    mine = signs.get(type(node.ops[0]))
    left, right = code.closed(node.left), code.closed(node.comparators[0])
    if mine is None:
        return
    for sign in ("<", "<=", ">", ">=") if mine[0] in "<>" else ("==", "!="):
        if sign != mine:
            edge = {mine, sign} in ({"<", "<="}, {">", ">="})
            yield (
                ("a condition at its edge" if edge else "a condition turned round"),
                f"{left} {sign} {right}",
            )
