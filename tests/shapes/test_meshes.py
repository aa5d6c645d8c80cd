"""Visual meshes: made in code with known volumes, read from files, refused by what is wrong."""

import numpy as np
import pytest
from shapes.drawn_shapes import rotations

from course.shapes.mesh_makers import (
    box_mesh,
    bracket_mesh,
    convex_mesh,
    dumbbell_mesh,
    icosphere_mesh,
    mug_mesh,
    rod_mesh,
    torus_mesh,
)
from course.shapes.meshes import Mesh, connected, mesh_colliders, read_mesh

pytestmark = pytest.mark.slow  # with its like, left out of --quick

BOX = box_mesh([0, 0, 0], [1, 2, 3])
MADE = {
    "rod": (rod_mesh, 1),
    "box": (lambda: BOX, 1),
    "icosphere": (icosphere_mesh, 1),
    "torus": (torus_mesh, 1),
    "dumbbell": (lambda: dumbbell_mesh(sides=10), 3),
    "bracket": (bracket_mesh, 2),
    "mug": (mug_mesh, 17),
}


@pytest.mark.parametrize("make, parts", MADE.values(), ids=MADE)
def test_made_meshes_have_their_parts(make, parts):
    mesh = make()
    assert len(mesh.parts()) == parts
    volumes = [part.volume() for part in mesh.parts()]
    assert sum(volumes) == pytest.approx(mesh.volume()) and min(volumes) > 0
    turn = rotations(np.random.default_rng(1), 1)[0]
    assert mesh.moved(turn, [1, 2, 3]).volume() == pytest.approx(mesh.volume())
    again = Mesh.joined(mesh.parts())
    assert again.volume() == pytest.approx(mesh.volume())


@pytest.mark.parametrize("name", [name for name in MADE if name != "torus"])
def test_hulls_of_convex_parts_follow_the_mesh(name):
    mesh = MADE[name][0]()
    assert mesh_colliders(mesh).volume() == pytest.approx(mesh.volume(), rel=1e-12)


def test_parts_touch_and_do_not_overlap():
    """Points drawn about a dumbbell and a mug are inside one part at most."""
    rng = np.random.default_rng(2)
    for mesh in (dumbbell_mesh(sides=10), mug_mesh(), bracket_mesh()):
        points = rng.uniform(*_range(mesh), size=(3000, 3))
        inside = [_inside(part, points) for part in mesh.parts()]
        assert np.sum(inside, axis=0).max() == 1
        share = np.any(inside, axis=0).mean()
        whole = np.prod(np.ptp(mesh.vertices, axis=0))
        error = np.sqrt(share * (1 - share) / len(points)) * whole
        assert abs(share * whole - mesh.volume()) < 5 * error


def _range(mesh):
    return mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)


def _inside(mesh, points):
    """Inside a convex mesh: below the planes of all its triangles, a little."""
    a, b, c = (mesh.vertices[mesh.triangles[:, i]] for i in range(3))
    n = np.cross(b - a, c - a)
    size = np.linalg.norm(n, axis=1) * np.ptp(mesh.vertices)
    return (points @ n.T - np.sum(n * a, axis=1) < -1e-9 * size).all(axis=1)


def test_volumes_near_those_of_the_curved_solids():
    """From below, with an error that falls with the square of the pieces' size."""
    for make, exact in (
        (lambda k: rod_mesh(2, 0.5, sides=8 * k), np.pi * 0.5),
        (lambda k: torus_mesh(1, 0.25, around=8 * k, across=8 * k), np.pi**2 / 8),
        (lambda k: icosphere_mesh(2, subdivisions=1 + k // 2), 32 / 3 * np.pi),
    ):
        coarse, fine = (exact - make(k).volume() for k in (2, 4))
        assert 0 < fine < coarse and coarse / fine == pytest.approx(4, rel=0.1)
    # Two balls without the caps that the bar cuts off, and the bar between the cuts.
    cap = 0.1 - (0.1**2 - 0.03**2) ** 0.5
    caps = np.pi * cap**2 * (0.3 - cap) / 3
    exact = 2 * (4 / 3 * np.pi * 0.1**3 - caps) + np.pi * 0.03**2 * (0.2 + 2 * cap)
    assert dumbbell_mesh(sides=48).volume() == pytest.approx(exact, rel=1e-2)
    assert bracket_mesh(0.2, 0.1, 0.02).volume() == pytest.approx(0.1 * 0.02 * 0.38)


def test_what_is_wrong_with_a_mesh_is_said():
    points, rows = BOX.vertices, BOX.triangles
    flipped = rows.copy()
    flipped[3] = flipped[3][::-1]
    nan = points.copy()
    nan[5, 1] = np.nan
    for vertices, triangles, said in (
        (points, rows[:-1], "triangles: expected a closed surface; got 3 open edges"),
        (points, rows[2:], "got 4 open edges"),
        (points, rows[:, ::-1], "got part 0 inside out, volume -6.0"),
        (points, flipped, "got 3 edges whose two triangles face opposite ways"),
        (points * [1, 1, 0], rows, "expected parts with a volume; got part 0 that is flat"),
        (nan, rows, "vertices: expected finite vectors .* got nan"),
        (points, np.zeros((0, 3), int), "triangles: expected at least one triangle"),
        (points, np.concatenate([rows, [[0, 0, 1]]]), "got 1 with a corner twice"),
        (points, np.concatenate([rows, rows]), "edges that more than two triangles share"),
        (points, rows + 1, "triangles: expected whole numbers from 0 to 7; got 8"),
        (points, rows * 1.0, "triangles: expected whole numbers"),
        (points[None], rows, "vertices: expected shape"),
        (points, rows[:, :2], "triangles: expected shape"),
    ):  # fmt: skip
        with pytest.raises(ValueError, match=said):
            Mesh(vertices, triangles)


def test_the_part_at_fault_is_named():
    bad = np.concatenate([BOX.triangles, (BOX.triangles + 8)[:, ::-1]])
    with pytest.raises(ValueError, match="part 1 inside out"):
        Mesh(np.concatenate([BOX.vertices, BOX.vertices + 9]), bad)


def test_parts_come_in_the_order_of_their_triangles():
    rows = np.array([[5, 6, 7], [0, 1, 2], [7, 6, 5], [2, 1, 0]])
    assert [part.tolist() for part in connected(rows)] == [[0, 2], [1, 3]]


@pytest.mark.parametrize(
    "make, said",
    [
        (lambda: rod_mesh(0), "length: expected a positive number"),
        (lambda: rod_mesh(sides=2), "sides: expected a whole number of at least 3"),
        (lambda: icosphere_mesh(-1), "radius"),
        (lambda: icosphere_mesh(subdivisions=9), "subdivisions: expected at most 6"),
        (lambda: torus_mesh(1, 1), "tube_radius: expected a number below ring_radius"),
        (lambda: dumbbell_mesh(bar_radius=0.2), "bar_radius"),
        (lambda: dumbbell_mesh(length=0.1), "length: expected a number above 2"),
        (lambda: bracket_mesh(thickness=0.3), "thickness: expected a number below arm"),
        (lambda: mug_mesh(thickness=0.3), "thickness: expected a number below radius"),
        (lambda: convex_mesh(np.zeros((3, 3))), "triangles"),
        (lambda: Mesh.joined([]), "parts: expected at least one Mesh"),
        (lambda: mesh_colliders(3), "mesh"),
        (lambda: BOX.moved(np.eye(3), np.zeros((2, 3))), "translation: expected shape"),
    ],
)
def test_a_wrong_argument_is_named(make, said):
    with pytest.raises(ValueError, match=said):
        make()


# Files. trimesh is an extra; without it these are skipped.


def obj_text(mesh):
    points = "".join(f"v {x} {y} {z}\n" for x, y, z in mesh.vertices.tolist())
    return points + "".join(f"f {a} {b} {c}\n" for a, b, c in (mesh.triangles + 1).tolist())  # fmt: skip


def stl_text(mesh):
    """As STL has it: each triangle with corners of its own."""
    facets = []
    for row in mesh.triangles:
        corners = "".join(f"vertex {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in mesh.vertices[row])  # fmt: skip
        facets.append(f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    return f"solid x\n{''.join(facets)}endsolid x\n"


def test_a_file_of_parts_that_touch(tmp_path):
    pytest.importorskip("trimesh")
    mesh = bracket_mesh()
    (tmp_path / "mine.obj").write_text(obj_text(mesh))
    found = read_mesh(tmp_path / "mine.obj")
    assert found.volume() == pytest.approx(mesh.volume())
    assert len(mesh_colliders(found).parts) == 2


def test_a_file_of_triangles_with_corners_of_their_own(tmp_path):
    pytest.importorskip("trimesh")
    ball = icosphere_mesh(subdivisions=1)
    mesh = Mesh.joined([ball, torus_mesh(4, 1, around=8, across=6)])
    (tmp_path / "mine.STL").write_text(stl_text(mesh))
    found = read_mesh(tmp_path / "mine.STL")
    assert found.volume() == pytest.approx(mesh.volume(), rel=1e-6)
    colliders = mesh_colliders(found)
    assert colliders.parts[0].volume() == pytest.approx(ball.volume(), rel=1e-6)
    assert len(colliders.parts) == 2


def test_a_file_of_quadrilaterals(tmp_path):
    pytest.importorskip("trimesh")
    quads = ["1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"]
    points = [f"v {i} {j} {k}" for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    path = tmp_path / "cube.obj"
    path.write_text("\n".join(points + [f"f {q}" for q in quads]))
    assert read_mesh(path).volume() == pytest.approx(1)


def test_broken_files_are_refused_by_what_is_wrong_with_them(tmp_path):
    pytest.importorskip("trimesh")
    open_text = "\n".join(obj_text(BOX).splitlines()[:-1])
    for name, text, said in (
        ("open.obj", open_text, r"open.obj: triangles: .*got 3 open edges"),
        ("inside.stl", stl_text(Mirrored), "inside.stl: .*inside out"),
        (
            "nan.obj",
            obj_text(BOX).replace("v 1.0", "v nan", 1),
            "nan.obj: vertices: .*nan",
        ),
        ("points.obj", "v 0 0 0\nv 1 0 0\n", "path: expected"),
        ("empty.stl", "", "path: expected"),
        ("noise.stl", "solid of nothing", "path: expected"),
        ("index.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n", "path: expected|index.obj"),
        ("mesh.ply", "ply", "path: expected a file that ends in .obj or .stl"),
        ("no_ending", "", "path: expected a file that ends"),
    ):
        (tmp_path / name).write_text(text)
        with pytest.raises(ValueError, match=said):
            read_mesh(tmp_path / name)
    with pytest.raises(ValueError, match="path: expected a file that exists"):
        read_mesh(tmp_path / "nowhere.obj")


class Mirrored:
    """A box whose triangles face inward, which Mesh itself would refuse."""

    vertices, triangles = BOX.vertices, BOX.triangles[:, ::-1]


def test_without_trimesh_it_is_said_what_to_install(tmp_path, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "trimesh", None)
    (tmp_path / "a.obj").write_text(obj_text(BOX))
    with pytest.raises(ModuleNotFoundError, match=r"collision-course\[meshes\]"):
        read_mesh(tmp_path / "a.obj")
