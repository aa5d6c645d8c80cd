"""Changes of statements: a line too many, two in the wrong order, += for =, a return inside a loop."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from itertools import combinations

from course.exercises.repair.names import TWINS, renamed, twin_names
from course.exercises.repair.places import Code, Edit, Patch, patched

SIMPLE = (ast.Assign, ast.AugAssign, ast.AnnAssign, ast.Expr)


def statement_edits(code: Code) -> Iterator[Edit]:
    """Every change of whole statements."""
    for block in code.blocks():
        for place, statement in enumerate(block):
            yield from _too_many(code, block, statement)
            yield from _moved(code, block, place)
            yield from _augmented(code, statement)
            yield from _copied(code, statement)
            yield from _returns_too_early(code, statement)
            yield from _conditions(code, statement)
            yield from _unlike_its_twin(code, block, statement)
            if isinstance(statement, (*SIMPLE, ast.Return)):
                yield from _names_throughout(code, statement)
    yield from _sines_and_cosines(code)


def _one(
    code: Code, kind: str, stage: int, node: ast.stmt | ast.expr, text: str
) -> Edit:
    return Edit(kind, stage, ((*code.span(node), text),), node.lineno)


def _too_many(code: Code, block: list[ast.stmt], statement: ast.stmt) -> Iterator[Edit]:
    if not isinstance(
        statement, (ast.Return, ast.FunctionDef, ast.Import, ast.ImportFrom)
    ):
        yield _one(code, "a line too many", 1, statement, "pass")
    if isinstance(statement, ast.If) and statement.body and not statement.orelse:
        yield Edit(
            "a condition too many",
            1,
            ((*code.span(statement.test), "True"),),
            statement.lineno,
        )


def _moved(code: Code, block: list[ast.stmt], place: int) -> Iterator[Edit]:
    """A simple line before or after another of its block."""
    statement = block[place]
    if not isinstance(statement, SIMPLE):
        return
    text, here = code.text(statement), code.span(statement)
    for to, other in enumerate(block):
        if to == place or (
            to == place + 1 and isinstance(other, SIMPLE) and to < len(block) - 1
        ):
            continue
        start, end = code.span(other)
        margin = " " * other.col_offset
        patches: tuple[Patch, ...] = (
            (*here, "pass"),
            (start, start, f"{text}\n{margin}"),
        )
        if to > place and not isinstance(other, ast.Return):
            patches = ((*here, "pass"), (end, end, f"\n{margin}{text}"))
        yield Edit("a line in the wrong place", 1, patches, statement.lineno)


def _returns_too_early(code: Code, statement: ast.stmt) -> Iterator[Edit]:
    """A return inside a loop moved behind it; or what it gives added up over the loop, from 0."""
    if not isinstance(statement, ast.For):
        return
    inner = [n for n in ast.walk(statement) if isinstance(n, ast.Return) and n.value]
    if len(inner) != 1 or inner[0].value is None:
        return
    (start, _), (_, end) = code.span(statement), code.span(statement)
    margin, value = " " * statement.col_offset, code.text(inner[0].value)
    here, kind = code.span(inner[0]), "a return inside a loop, which ends it"
    before: Patch = (start, start, f"sum_ = 0.0\n{margin}")
    summed, behind = f"sum_ = sum_ + ({value})", f"\n{margin}return "
    moved: tuple[Patch, ...] = ((*here, f"pass{behind}{value}"),)
    added: tuple[Patch, ...] = (before, (*here, f"{summed}{behind}sum_"))
    if end != here[1]:
        moved = ((*here, "pass"), (end, end, behind + value))
        added = (before, (*here, summed), (end, end, f"{behind}sum_"))
    yield Edit(kind, 1, moved, inner[0].lineno)
    yield Edit(kind, 1, added, inner[0].lineno)


def _augmented(code: Code, statement: ast.stmt) -> Iterator[Edit]:
    if not isinstance(statement, ast.AugAssign):
        if isinstance(statement, ast.Assign) and isinstance(
            statement.targets[0], (ast.Name, ast.Subscript)
        ):
            target, value = code.text(statement.targets[0]), code.text(statement.value)
            yield _one(code, "= where += belongs", 1, statement, f"{target} += {value}")
        return
    signs = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
    sign = signs.get(type(statement.op))
    if sign is None:
        return
    target, value = code.text(statement.target), code.text(statement.value)
    yield _one(code, f"{sign}= where = belongs", 1, statement, f"{target} = {value}")
    yield _one(
        code,
        f"{sign}= on an argument",
        1,
        statement,
        f"{target} = {target} {sign} ({value})",
    )
    for other in "+-":
        if other != sign:
            yield _one(
                code, "the sign of a term", 1, statement, f"{target} {other}= {value}"
            )
    if isinstance(statement.value, ast.Call):
        call = statement.value
        texts = [code.text(a) for a in call.args]
        for i, text in enumerate(texts):
            inside = ", ".join(
                [*texts[:i], f"{target} {sign} ({text})", *texts[i + 1 :]]
            )
            yield _one(
                code,
                "brackets",
                1,
                statement,
                f"{target} = {code.text(call.func)}({inside})",
            )


def _copied(code: Code, statement: ast.stmt) -> Iterator[Edit]:
    """b = a.copy() for b = a, where b[...] is written to: else that writes to a as well."""
    if not isinstance(statement, ast.Assign) or not isinstance(
        statement.value, ast.Name
    ):
        return
    names = {t.id for t in statement.targets if isinstance(t, ast.Name)}
    written = {
        n.value.id
        for n in ast.walk(code.tree)
        if isinstance(n, ast.Subscript)
        and isinstance(n.ctx, ast.Store)
        and isinstance(n.value, ast.Name)
    }
    if names & written:
        text = f"np.array({statement.value.id})"
        yield _one(code, "a second name where a copy belongs", 1, statement.value, text)


def _conditions(code: Code, statement: ast.stmt) -> Iterator[Edit]:
    if isinstance(statement, (ast.If, ast.While)):
        text = f"not ({code.text(statement.test)})"
        yield _one(code, "a condition turned round", 1, statement.test, text)
    if isinstance(statement, ast.Return) and isinstance(statement.value, ast.Name):
        name = statement.value.id
        for entry in (f"{name}[..., 0]", f"{name}[..., None]", f"{name}.T"):
            yield _one(code, "the shape of the result", 2, statement.value, entry)


def _unlike_its_twin(
    code: Code, block: list[ast.stmt], statement: ast.stmt
) -> Iterator[Edit]:
    """x_b = ... made of the line x_a = ... ."""
    mine = _assigned(statement)
    for other in block if mine else ():
        theirs = _assigned(other)
        if mine is None or theirs is None or theirs[0] == mine[0]:
            continue
        for pair in TWINS:
            for one, two in (pair, pair[::-1]):
                if twin_names(theirs[0], one, two) == mine[0]:
                    table = {n: twin_names(n, one, two) for n in code_names(theirs[1])}
                    start, end = code.span(theirs[1])
                    patches = renamed(code, theirs[1], table)
                    moved = tuple((x - start, y - start, t) for x, y, t in patches)
                    text = patched(code.source[start:end], moved)
                    if text != code.text(mine[1]):
                        kind = "unlike the line of its twin"
                        yield _one(code, kind, 2, mine[1], f"({text})")


def code_names(node: ast.AST) -> set[str]:
    """The names that are read in a node."""
    return {n.id for n in ast.walk(node) if isinstance(n, ast.Name)}


def _assigned(statement: ast.stmt) -> tuple[str, ast.expr] | None:
    """The name and the value of an assignment to one name."""
    if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name):
        return statement.targets[0].id, statement.value
    return None


def _names_throughout(code: Code, statement: ast.stmt) -> Iterator[Edit]:
    """One name for another in several places of a line; two twins exchanged; all of one pair for another."""
    reads = [
        n
        for n in ast.walk(statement)
        if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)
    ]
    own = [n for n in reads if n.id in code.axes]
    names = sorted({n.id for n in own})
    for name in names:
        nodes = [n for n in own if n.id == name]
        sets = [nodes] if len(nodes) > 1 else []
        if 2 < len(nodes) <= 4:
            sets += [list(c) for c in combinations(nodes, 2)]
        for some in sets:
            for other in code.axes:
                if other != name and code.axes[other] == code.axes[name]:
                    patches = tuple((*code.span(n), other) for n in some)
                    yield Edit("another name", 2, patches, statement.lineno)
    for one, two in combinations(names, 2):
        patches = tuple(renamed(code, statement, {one: two, two: one}))
        yield Edit("two names exchanged", 2, patches, statement.lineno)
    yield from _other_pair(code, statement, names)


def _other_pair(code: Code, statement: ast.stmt, names: list[str]) -> Iterator[Edit]:
    """x_a, x_b where p_a, p_b belong."""
    stems: dict[str, dict[str, str]] = {}
    for name in code.axes:
        found = re.fullmatch(r"(.*?)_?(a|b|1|2|i|j)(_dot|_ddot|_old|_new)?", name)
        if found:
            stems.setdefault(f"{found[1]}*{found[3] or ''}", {})[found[2]] = name
    for mine in stems.values():
        for other in stems.values():
            table = {
                mine[k]: other[k] for k in mine if k in other and mine is not other
            }
            used = set(names) & set(table)
            if len(used) < 2:
                continue
            for node in [statement, *ast.walk(statement)]:
                if (
                    isinstance(node, (ast.BinOp, ast.Call, ast.stmt))
                    and len(code_names(node) & used) > 1
                ):
                    patches = tuple(renamed(code, node, table))
                    yield Edit("the names of another pair", 2, patches, node.lineno)


def _sines_and_cosines(code: Code) -> Iterator[Edit]:
    """All sines and cosines exchanged."""
    other = {"sin": "cos", "cos": "sin"}
    patches: list[Patch] = []
    line = 0
    for node in ast.walk(code.tree):
        if isinstance(node, ast.Call) and isinstance(
            node.func, (ast.Attribute, ast.Name)
        ):
            end = code.span(node.func)[1]
            name = code.source[end - 3 : end]
            if name in other:
                patches.append((end - 3, end, other[name]))
                line = line or node.lineno
    if len(patches) > 1:
        yield Edit("sine and cosine exchanged", 1, tuple(patches), line)
