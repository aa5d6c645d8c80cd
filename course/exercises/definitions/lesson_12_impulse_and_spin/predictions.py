"""The predictions of this lesson, and how each is computed."""

from __future__ import annotations

import numpy as np

from course import formulas
from course.dynamics import effective_mass
from course.exercises.definition import Prediction


def _rod_centre() -> float:
    from course.contact import resolve_collisions
    from course.scenes import falling_rods

    rod = falling_rods(0.0)
    return float(resolve_collisions(rod.bodies, rod.contacts, 1.0).velocity[0, 2])


def _halfway() -> float:
    from course.scenes import falling_rods

    rod = falling_rods(0.0, place=0.5)
    return float(effective_mass(rod.bodies, rod.contacts)[0])


def _box_in_turn() -> str:
    from course.contact import resolve_collisions
    from course.scenes import box_on_corners

    box = box_on_corners()
    after = resolve_collisions(box.bodies, box.contacts, 1.0, law="sequential")
    return "turns" if np.linalg.norm(after.angular_velocity[0]) > 1e-6 else "straight"


def _clamped() -> str:
    u = np.array([-1.0, 0.1])
    a = np.array([[2.0, -1.0], [-1.0, 2.0]])
    push = formulas.simultaneous_impulses(a, np.array([2 * u[0], u[1]]), 0.0)
    change = float(push @ u + 0.5 * push @ a @ push)
    return "kept" if abs(change) < 1e-9 else "gained" if change > 0 else "lost"


PREDICTIONS = (
    Prediction(
        "rod_centre",
        "A rod falls flat at 1 m/s, and a fixed peg hits its end; nothing is lost. How fast does the rod's *centre* "
        "move just after? (Upward is positive.)",
        _rod_centre,
        "The peg gives 0.5 N s, and that takes 0.5 m/s from a rod of 1 kg: its centre goes on falling at half speed. "
        "The rest of the energy is in the spin.",
        unit="m/s",
        tolerance=0.01,
        later="See",
        wrong={
            1: "So a ball would bounce. Only the *end* of the rod comes back at 1 m/s.",
            0: "All the energy in the spin? The peg is too weak to stop the centre.",
            0.5: "Half the speed is right, but the centre still goes down.",
            -1: "The peg pushes the whole rod, not only its end: the centre changes by impulse over mass.",
        },
    ),
    Prediction(
        "halfway",
        "A rod of 1 kg feels like 1 kg when it is hit at its middle and like 0.25 kg at its end. How heavy does "
        "it feel half way between the two?",
        _halfway,
        "The lever is half as long, and it counts squared: 1/mu = 1 + 3/4, so mu = 4/7 kg.",
        unit="kg",
        tolerance=0.01,
        wrong={
            0.625: "The mean of the two. But what falls off evenly is the lever, and 1/mu grows with its square.",
            0.4: "The mean of 1 and 4 in 1/mu. The lever counts squared: half of it adds a quarter of 3.",
            0.5: "Half the lever is not half the mass.",
        },
    ),
    Prediction(
        "box_in_turn",
        "A box lands flat on its four corners, nothing is lost. The program hits one corner after the other, "
        "each as if it were alone, until none approaches. What does the box do?",
        _box_in_turn,
        "The first corner turns the box, so the next ones come in at other speeds. Every single hit is right, and yet "
        "the box tumbles; the order in the list decides which way.",
        choices={
            "straight": "it flies straight up at the speed it came with",
            "turns": "it flies up and turns",
        },
        wrong={"straight": "So a fair law would have it: nothing prefers one corner."},
    ),
    Prediction(
        "clamped",
        "Three balls of 1 kg touch and move at 1, 0 and 0.1 m/s. A program asks the first contact, which closes, "
        "to part as fast as it closed (e = 1), and the second, which already parts, only not to close. What "
        "becomes of the kinetic energy?",
        _clamped,
        "The second contact comes to be squeezed and gets an impulse while it parts: that is work done on the balls. "
        "They leave at -0.3, 0.7 and 0.7 m/s with 0.535 J; they came with 0.505 J.",
        choices={
            "kept": "it is kept",
            "lost": "some is lost",
            "gained": "some is gained",
        },
        wrong={
            "kept": "e = 1 keeps it for one contact. For several, it depends on which contacts it is asked of.",
            "lost": "The second contact looks plastic, but it was parting: the impulse there speeds things up.",
        },
    ),
)
