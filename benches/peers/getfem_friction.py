#!/usr/bin/python3
"""A flat punch with friction on an exponentially graded layer, by GetFEM: `getfem_friction.py LEVELS` prints a JSON object
for each mesh and each kind of friction. See README.md.

What sticks is the middle, up to one of the mesh's corners: there `u(1) = 0`, beside it the shear is `eta p`. That is
linear. Which corner it is, is bisected for: beside the end of too long a stick zone the shear is singular, and beyond
`eta p`; of too short a one it is singular the other way. Between two corners the zone's end is interpolated. (Newton's method on the law itself, stick or
slip decided at each point, went in circles on these meshes.)

`goodman` takes the pressure of the contact without friction, as slipzone does; `coulomb` lets the shear change it.
"""

import importlib.util
import json
import math
import os
import sys
import time

here = os.path.dirname(os.path.abspath(__file__))
spec = importlib.util.spec_from_file_location("frictionless", os.path.join(here, "getfem.py"))
frictionless = importlib.util.module_from_spec(spec)
spec.loader.exec_module(frictionless)  # takes this folder off the path of modules
getfem, np, PENALTY = frictionless.getfem, frictionless.np, frictionless.PENALTY

THICKNESS, RATIO, NU, ETA = 5.0, 8.0, 0.3, 0.3
LENGTH = 30.0
LAYERS = [(THICKNESS, f"exp({math.log(RATIO) / THICKNESS}*X(2))", NU)]


class Contact:
    def __init__(self, level, coupled):
        self.level, self.coupled = level, coupled
        _, self.field, self.rule, self.stress, model = frictionless.body(LAYERS, LENGTH, level)
        frictionless.press(model, self.rule)
        model.solve("lsolver", "mumps")
        self.pressed = model.variable("u")
        self.force = 2.0 * getfem.asm_generic(self.rule, 0, f"({self.stress}):Grad_u", -1, model)
        corner = np.array([[1e-12], [1e-12]])
        self.centre = -np.ravel(model.interpolation(f"({self.stress})(2,2)", corner, self.field.linked_mesh()))[0]
        self.corners = frictionless.lines(LAYERS, LENGTH, level)[0]
        self.corners = self.corners[self.corners <= 1.0]

    def excess(self, corner):
        """What the shear has of a singularity where sticking ends, over the limit of friction: its excess `e` over that
        is `K/sqrt(a - x) - C sqrt(a - x)` beside the end, `K` and `C` told by its means over the last two elements."""
        mesh, field, rule, _, model = frictionless.body(LAYERS, LENGTH, self.level)
        faces, normals, centre = frictionless.outer(mesh)
        under, (before, last, end) = (normals[1] < -0.5) & (centre[0] < 1.0), self.corners[corner - 2 : corner + 1]
        regions = {
            4: under & (centre[0] < end),
            5: under & (centre[0] > end),
            6: under & (centre[0] < end) & (centre[0] > last),
            7: under & (centre[0] < last) & (centre[0] > before),
        }
        for number, chosen in regions.items():
            mesh.set_region(number, faces[:, chosen])
        if self.coupled:
            frictionless.press(model, rule)
            pressure = f"({PENALTY}*(1-u(2)))"
            model.add_linear_term(rule, f"{ETA * PENALTY}*u(2)*Test_u(1)", 5)
            model.add_source_term(rule, f"{ETA * PENALTY}*Test_u(1)", 5)
        else:
            model.add_initialized_fem_data("w", field, self.pressed)
            pressure = f"({PENALTY}*(1-w(2)))"
            model.add_source_term(rule, f"{pressure}*Test_u(2)", 1)
            model.add_source_term(rule, f"{ETA}*{pressure}*Test_u(1)", 5)
        model.add_linear_term(rule, f"{PENALTY}*u(1)*Test_u(1)", 4)
        model.solve("lsolver", "mumps")
        self.last_force = 2.0 * getfem.asm_generic(rule, 0, pressure, 1, model)
        # Displacements at the right are inwards, hence negative, and the shear that holds them back outwards.
        of = lambda region, traction: getfem.asm_generic(rule, 0, traction, region, model)
        means = [of(r, f"-{PENALTY}*u(1)") / (ETA * of(r, pressure)) - 1.0 for r in (6, 7)]
        ends = end - np.array([[end, last], [last, before]])
        mean = lambda power: (ends[:, 1] ** power - ends[:, 0] ** power) / power / (ends[:, 1] - ends[:, 0])
        return np.linalg.solve(np.array([mean(0.5), -mean(1.5)]).T, means)[0]

    def stick(self):
        """Where the excess vanishes."""
        low, high = 2, len(self.corners) - 2
        below, above = self.excess(low), self.excess(high)
        while high - low > 1:
            middle = (low + high) // 2
            found = self.excess(middle)
            if found < 0:
                low, below = middle, found
            else:
                high, above = middle, found
        return self.corners[low] + (self.corners[high] - self.corners[low]) * below / (below - above)


def timed(run, rounds):
    """What it gives, and the least processor time of so many runs: minutes on a shared machine belong to others, too."""
    times = []
    for _ in range(rounds):
        started = time.process_time()
        found = run()
        times.append(time.process_time() - started)
    return found, min(times)


def main():
    for level in range(int(sys.argv[1]) + 1 if len(sys.argv) > 1 else 2):
        for kind in ("goodman", "coulomb"):
            rounds = max(1, 3 - 2 * level)
            contact, pressed = timed(lambda: Contact(level, kind == "coulomb"), 1 + rounds)
            ratio, searched = timed(contact.stick, rounds)
            print(json.dumps({
                "kind": kind, "unknowns": contact.field.nbdof(), "force": contact.force, "centre": contact.centre,
                "seconds": pressed, "ratio": ratio, "force_with_friction": contact.last_force,
                "seconds_with_friction": pressed + searched,
            }), flush=True)


if __name__ == "__main__":
    main()
