"""Changes of an expression that take one thing for another: operations, functions, arguments, axes, conditions."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from itertools import combinations, permutations

from course.exercises.repair.brackets import (
    brackets_put_in,
    inside_out,
    other_brackets,
    other_side,
    terms_into_brackets,
)
from course.exercises.repair.places import Code, Place, is_quantity, name_of_call
from course.exercises.repair.texts import (
    NO_STEP,
    SIGNS,
    Change,
    call_text,
    dot,
    is_product,
    is_sum,
    solved,
    times,
)

#: Functions that are easily taken for one another.
FUNCTIONS = {
    "sin": "cos tan", "cos": "sin", "tan": "sin cos", "minimum": "maximum", "maximum": "minimum", "min": "max",
    "max": "min sum mean", "mean": "sum max", "sum": "max cumsum prod mean", "cumsum": "sum cumprod", "prod": "sum",
    "any": "all", "all": "any", "argmax": "argmin", "argmin": "argmax", "zeros": "ones", "ones": "zeros",
    "floor": "ceil", "ceil": "floor", "outer": "cross", "sinh": "sin", "exp": "log", "log": "exp", "square": "sqrt",
    "sqrt": "square", "arcsin": "arccos", "arccos": "arcsin", "degrees": "radians", "radians": "degrees",
    "remove": "append", "append": "remove", "pinv": "inv", "det": "trace", "floor_divide": "divide",
}  # fmt: skip


#: What einsum is asked for in the exercises: dot product, matrix times vector (or its transpose), matrix times matrix.
LETTERS = (
    "...i,...i->...",
    "...ij,...j->...i",
    "...ji,...j->...i",
    "...ij,...jk->...ik",
)


OVER_AXES = frozenset("sum norm max min mean cumsum prod any all argmax argmin".split())


def other(code: Code, place: Place) -> Iterator[Change]:
    """The expression with one part in another place, or taken for another of its kind."""
    node = place.node
    if isinstance(node, ast.BinOp):
        yield from _other_operation(code, node)
        yield from other_brackets(code, node)
        if is_sum(node):
            yield from terms_into_brackets(code, node)
        if not isinstance(place.parent, (ast.BinOp, ast.UnaryOp)):
            yield from brackets_put_in(code, node)
        if not isinstance(place.parent, ast.BinOp) or not is_product(place.parent):
            yield from other_side(code, node)
    elif isinstance(node, ast.Call):
        yield from _other_call(code, node)
        yield from inside_out(code, node)
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
        for number, rest in ((node.left, right), (node.right, left)):
            if isinstance(number, ast.Constant):
                yield "a number times it where 1 + it belongs", f"1 + {rest}"
                yield "a number times it where 1 - it belongs", f"1 - {rest}"
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
                dot(code.closed(inner.args[0]), code.closed(inner.args[1])),
            )
    if name == "einsum" and len(texts) == 3:
        for letters in LETTERS:
            text = call_text(code, node, arguments=[f'"{letters}"', *texts[1:]])
            yield "the letters of einsum()", text
    if name in ("cross", "dot", "inner", "vdot", "matmul") and len(texts) == 2:
        left, right = map(code.closed, node.args)
        # A name without np. may be a helper of the student's: of NumPy's nothing is said then.
        given = "" if isinstance(node.func, ast.Attribute) else "what comes of "
        kind = f"{given}{name}() where the dot product of vectors belongs"
        yield kind, dot(left, right)
        yield f"{name}() of a matrix and a batch of vectors", times(left, right)
        yield f"{name}() where * belongs", f"{left} * {right}"
        if name != "cross":
            yield (
                f"{name}() where a cross product belongs",
                f"np.cross({left}, {right})",
            )
    if name == "cross" and len(texts) == 2:
        yield from _product_rule(code, node)
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
        given = (
            texts[0]
            if len(texts) > 1 and texts[0] != "-1"
            else code.text(node.func)[: -len(".reshape")]
        )
        yield "a new shape where a new axis belongs", f"np.asarray({given})[..., None]"
        if len(texts) == 2 and isinstance(node.func, ast.Attribute):
            turned = f"{code.closed(node.func.value)}.reshape({texts[1]}, {texts[0]}).T"
            yield "reshape() where a transpose belongs", turned


def _product_rule(code: Code, node: ast.Call) -> Iterator[Change]:
    """a_dot x b_dot as a_dot x b + a x b_dot, where a_dot is omega x a or has that name."""
    whole = []
    for argument in node.args:
        text = code.text(argument)
        if name_of_call(argument) == "cross" and isinstance(argument, ast.Call):
            whole.append(code.text(argument.args[-1]))
        elif isinstance(argument, ast.Name) and text.endswith("_dot"):
            whole.append(text.removesuffix("_dot"))
    if len(whole) == 2:
        one, two = map(code.text, node.args)
        yield (
            "a product of two rates where the product rule belongs",
            f"np.cross({one}, {whole[1]}) + np.cross({whole[0]}, {two})",
        )


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
    for sign in ("<", "<=", ">", ">=") + (("==", "!=") if mine[0] in "=!" else ()):
        if sign != mine:
            yield _kind_of_comparison(mine, sign), f"{left} {sign} {right}"


def _kind_of_comparison(mine: str, sign: str) -> str:
    if {mine, sign} in ({"<", "<="}, {">", ">="}):
        return "a condition at its edge"
    turned = {mine, sign} == {"==", "!="} or {mine[0], sign[0]} == {"<", ">"}
    return "a condition turned round" if turned else "a condition of another kind"
