"""One-step mutants of a formula: its syntax tree with one node changed.

A mutant is what a slip of one place could make of the formula. Its key, the statement
before and after, stays the same when lines move.
"""

import ast
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from course.exercises.formula_source import source_of

ARITHMETIC = {
    ast.Add: (ast.Sub, ast.Mult),
    ast.Sub: (ast.Add,),
    ast.Mult: (ast.Div, ast.Add),
    ast.Div: (ast.Mult,),
    ast.Pow: (ast.Mult,),
    ast.MatMult: (ast.Mult,),
    ast.BitAnd: (ast.BitOr,),
    ast.BitOr: (ast.BitAnd,),
}
COMMUTATIVE = (ast.Add, ast.Mult, ast.BitAnd, ast.BitOr)
COMPARISONS = (ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.Eq, ast.NotEq)
CONTRARY = {ast.In: ast.NotIn, ast.NotIn: ast.In, ast.Is: ast.IsNot, ast.IsNot: ast.Is}
NUMBERS = (0, 1, 2, 0.5)
TWINS = {
    "sin": ("cos", "tan"),
    "cos": ("sin", "tan"),
    "sqrt": ("square",),
    "sum": ("max", "mean"),
    "cumsum": ("cumprod",),
    "max": ("min", "sum"),
    "min": ("max",),
    "maximum": ("minimum",),
    "minimum": ("maximum",),
    "abs": ("sign",),
    "sign": ("abs",),
    "zeros": ("ones",),
    "solve": ("matmul",),
    "cross": ("multiply",),
    "append": ("remove",),
    "remove": ("append",),
    "Minimize": ("Maximize",),
}
UNSIGNED = ("len", "zeros", "norm", "abs", "cos", "range", "RuntimeError")  # minus lost
SYMMETRIC = ("maximum", "minimum", "max", "min")


@dataclass(frozen=True)
class Mutant:
    """A changed formula: the changed statement before and after, and all of its text."""

    before: str
    after: str
    source: str

    @property
    def key(self) -> tuple[str, str]:
        return self.before, self.after


@dataclass(frozen=True)
class _Place:
    """Where a node hangs: ``parent.field``, or an item of that list."""

    parent: ast.AST
    field: str
    index: int | None
    statement: ast.stmt
    names: tuple[str, ...]

    @property
    def node(self) -> ast.AST:
        held = getattr(self.parent, self.field)
        return held if self.index is None else held[self.index]

    def put(self, node: object) -> None:
        if self.index is None:
            setattr(self.parent, self.field, node)
        else:
            getattr(self.parent, self.field)[self.index] = node


def mutants_of(formula: Callable[..., object]) -> list[Mutant]:
    """All mutants of a formula that differ from it and from each other as text."""
    return mutants_in(source_of(formula))


def mutants_in(source: str) -> list[Mutant]:
    """All mutants of a function's source."""
    tree = ast.parse(source)
    function = tree.body[0]
    assert isinstance(function, ast.FunctionDef)
    if ast.get_docstring(function) is not None:
        del function.body[0]
    seen, made = {ast.unparse(tree)}, []
    taken: dict[tuple[str, str], int] = {}
    for place in list(_places(function)):
        original = place.node
        before = _head(place.statement)
        for changed in list(_changes(place)):
            place.put(changed)
            source = ast.unparse(ast.fix_missing_locations(tree))
            after = _head(changed if place.statement is original else place.statement)
            place.put(original)
            if source in seen:
                continue
            seen.add(source)
            count = taken[before, after] = taken.get((before, after), 0) + 1
            made.append(Mutant(before, after + f"  # {count}" * (count > 1), source))
    return made


def _head(statement: ast.AST) -> str:
    """A statement in one line; of a loop only the line that opens it."""
    lines = ast.unparse(statement).splitlines()
    if not isinstance(statement, (ast.For, ast.If, ast.FunctionDef)):
        return " ".join(lines)
    ends = isinstance(statement.body[-1], (ast.Break, ast.Return))
    return lines[0] + f" ... {ast.unparse(statement.body[-1])}" * ends


def _places(function: ast.FunctionDef) -> Iterator[_Place]:
    names = tuple(
        dict.fromkeys(
            [a.arg for a in function.args.args]
            + [
                n.id
                for n in ast.walk(function)
                if isinstance(n, ast.Name)
                and isinstance(n.ctx, ast.Store)
                and n.id != "_"
            ]
        )
    )

    def below(node: ast.AST, statement: ast.stmt | None) -> Iterator[_Place]:
        for field, value in ast.iter_fields(node):
            if isinstance(node, ast.FunctionDef) and field == "args":
                continue
            held = value if isinstance(value, list) else [value]
            for i, child in enumerate(held):
                if not isinstance(child, ast.AST):
                    continue
                own = child if isinstance(child, ast.stmt) else statement
                if isinstance(child, (ast.Import, ast.ImportFrom)) or own is None:
                    continue
                if isinstance(node, ast.Call) and _called(node) == "reshape":
                    if isinstance(child, ast.UnaryOp):
                        continue  # -1, NumPy's word for "what is left", is no number
                index = i if isinstance(value, list) else None
                yield _Place(node, field, index, own, names)
                if not isinstance(child, ast.Raise):  # its words are nobody's mistake
                    yield from below(child, own)

    yield from below(function, None)


def _changes(place: _Place) -> Iterator[ast.AST]:
    """What one slip may put in a node's place."""
    node = place.node
    if isinstance(node, ast.stmt):
        yield from _statements(node, place)
    elif isinstance(node, ast.keyword):
        yield from _keywords(node)
    elif isinstance(node, ast.comprehension):
        yield from _filters(node)
    elif isinstance(node, ast.expr) and not _is_stored(node):
        rule = RULES.get(type(node))
        if rule is not None:
            yield from rule(node, place)
        if _stands_alone(place):
            yield ast.UnaryOp(ast.USub(), node)


def _is_stored(node: ast.expr) -> bool:
    return isinstance(getattr(node, "ctx", None), ast.Store)


def _stands_alone(place: _Place) -> bool:
    """Whether a minus may be put before it: a result, a value given a name, an argument."""
    fixed = isinstance(place.node, ast.Constant) and (
        isinstance(place.node.value, str) or place.node.value == 0
    )
    several = (ast.UnaryOp, ast.Tuple, ast.List, ast.Slice, ast.Starred)
    if fixed or isinstance(place.node, several):
        return False
    if isinstance(place.parent, ast.Call) and _called(place.parent) in UNSIGNED:
        return False
    if isinstance(place.node, ast.Call) and _called(place.node) == "zeros":
        return False
    if isinstance(place.parent, (ast.Assign, ast.AugAssign, ast.Return)):
        return place.field == "value"
    return (isinstance(place.parent, ast.Call) and place.field == "args") or (
        isinstance(place.parent, (ast.Tuple, ast.IfExp)) and place.field != "test"
    )


def _called(node: ast.Call) -> str:
    return getattr(node.func, "attr", getattr(node.func, "id", ""))


def _statements(node: ast.stmt, place: _Place) -> Iterator[ast.AST]:
    if not isinstance(node, (ast.FunctionDef, ast.Pass)):
        yield ast.Pass()
    if isinstance(node, ast.AugAssign):
        yield ast.Assign([node.target], node.value, lineno=0)
        yield ast.AugAssign(node.target, ast.Sub(), node.value)
    if isinstance(node, ast.If):
        for test in (ast.Constant(True), ast.UnaryOp(ast.Not(), node.test)):
            yield _with(node, test=test)
    if isinstance(node, ast.For):
        ends = [ast.Break()]
        ends += [
            s for s in getattr(place.parent, place.field) if isinstance(s, ast.Return)
        ]
        yield from (_with(node, body=[*node.body, end]) for end in ends)


def _keywords(node: ast.keyword) -> Iterator[ast.AST]:
    if node.arg in ("axis", "axis1", "axis2"):
        for axis in (0, 1, -1, -2, None):
            yield ast.keyword(node.arg, ast.Constant(axis))


def _filters(node: ast.comprehension) -> Iterator[ast.AST]:
    for i in range(len(node.ifs)):
        yield _with(node, ifs=node.ifs[:i] + node.ifs[i + 1 :])


def _operations(node: ast.BinOp, place: _Place) -> Iterator[ast.AST]:
    for other in ARITHMETIC.get(type(node.op), ()):
        yield ast.BinOp(node.left, other(), node.right)
    yield node.left
    yield node.right
    if isinstance(node.op, ast.Sub):
        yield ast.UnaryOp(ast.USub(), node.right)
    if not isinstance(node.op, COMMUTATIVE):
        yield ast.BinOp(node.right, node.op, node.left)
    if isinstance(node.op, (ast.Mult, ast.Div)) and isinstance(node.left, ast.BinOp):
        inner = node.left  # brackets left out: (a + b) c becomes a + b c
        if isinstance(inner.op, (ast.Add, ast.Sub)):
            right = ast.BinOp(inner.right, node.op, node.right)
            yield ast.BinOp(inner.left, inner.op, right)


def _signs(node: ast.UnaryOp, place: _Place) -> Iterator[ast.AST]:
    yield node.operand


def _constants(node: ast.Constant, place: _Place) -> Iterator[ast.AST]:
    value = node.value
    if isinstance(value, bool):
        yield ast.Constant(not value)
    elif isinstance(value, (int, float)):
        others = [*NUMBERS, value + 1, value - 1]
        if value != 0 and not isinstance(place.parent, ast.UnaryOp):
            others.append(-value)
        yield from (ast.Constant(n) for n in dict.fromkeys(others) if n != value)
    elif isinstance(value, str):
        yield from (ast.Constant(text) for text in _words(value))


def _words(text: str) -> Iterator[str]:
    """The twin of a word of a closed list; of einsum's letters, each operand's reversed."""
    if text.startswith("face_"):
        yield "face_a" if text.endswith("b") else "face_b"
    if "->" in text:
        operands, result = text.split("->")
        parts = operands.split(",")
        for i, part in enumerate(parts):
            letters = part.replace("...", "")
            turned = part.replace(letters, letters[::-1])
            yield ",".join([*parts[:i], turned, *parts[i + 1 :]]) + "->" + result


def _comparisons(node: ast.Compare, place: _Place) -> Iterator[ast.AST]:
    (op,) = node.ops
    others = COMPARISONS if isinstance(op, COMPARISONS) else (CONTRARY[type(op)],)
    for other in others:
        yield _with(node, ops=[other()])
    yield ast.Constant(True)
    yield ast.Constant(False)


def _choices(node: ast.IfExp, place: _Place) -> Iterator[ast.AST]:
    yield node.body
    yield node.orelse
    yield _with(node, body=node.orelse, orelse=node.body)


def _names(node: ast.Name, place: _Place) -> Iterator[ast.AST]:
    if node.id in place.names:
        yield from (_with(node, id=name) for name in place.names if name != node.id)


def _subscripts(node: ast.Subscript, place: _Place) -> Iterator[ast.AST]:
    yield node.value
    entries = node.slice.elts if isinstance(node.slice, ast.Tuple) else []
    if len(entries) == 2:
        yield _with(node, slice=_with(node.slice, elts=entries[::-1]))


def _attributes(node: ast.Attribute, place: _Place) -> Iterator[ast.AST]:
    if node.attr == "T":
        yield node.value
    for twin in TWINS.get(node.attr, ()):
        yield _with(node, attr=twin)


def _calls(node: ast.Call, place: _Place) -> Iterator[ast.AST]:
    name = _called(node)
    if isinstance(node.func, ast.Name):
        for twin in TWINS.get(name, ()):
            yield _with(node, func=ast.Name(twin, ast.Load()))
    yield from (a for a in node.args if not isinstance(a, ast.Starred))
    for i, keyword in enumerate(node.keywords):
        if keyword.arg not in ("out", "where", "dtype", "solver"):
            yield _with(node, keywords=node.keywords[:i] + node.keywords[i + 1 :])
    if name not in SYMMETRIC:
        for i in range(len(node.args)):
            for j in range(i + 1, len(node.args)):
                args = list(node.args)
                args[i], args[j] = args[j], args[i]
                yield _with(node, args=args)
    if name == "range":
        (bound,) = node.args
        if not isinstance(bound, ast.Constant):
            for op in (ast.Add(), ast.Sub()):
                yield _with(node, args=[ast.BinOp(bound, op, ast.Constant(1))])
        yield _with(node, args=[ast.Constant(1), bound])


def _sequences(node: ast.Tuple | ast.List, place: _Place) -> Iterator[ast.AST]:
    if isinstance(place.parent, ast.Subscript):
        return
    for i in range(len(node.elts)):
        yield _with(node, elts=node.elts[:i] + node.elts[i + 1 :])
        for j in range(i + 1, len(node.elts)):
            elts = list(node.elts)
            elts[i], elts[j] = elts[j], elts[i]
            yield _with(node, elts=elts)


def _with(node, **fields):
    """A copy of a node with other fields; what hangs below is shared."""
    copy = type(node)(**{**dict(ast.iter_fields(node)), **fields})
    return ast.copy_location(copy, node)


RULES: dict[type, Callable] = {
    ast.BinOp: _operations,
    ast.UnaryOp: _signs,
    ast.Constant: _constants,
    ast.Compare: _comparisons,
    ast.IfExp: _choices,
    ast.Name: _names,
    ast.Subscript: _subscripts,
    ast.Attribute: _attributes,
    ast.Call: _calls,
    ast.Tuple: _sequences,
    ast.List: _sequences,
}
