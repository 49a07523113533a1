#!/usr/bin/python3
"""Flat punches without friction on three layers: finite elements by GetFEM against slipzone. See README.md.

Elements are biquadratic, crowded geometrically towards the punch's edge, where the pressure is unbounded. The punch is
pressed in by 1; the force is twice the work of the half that is meshed. All steps are halved from mesh to mesh, and its error falls to a quarter, as
measured: so two forces are extrapolated.
"""

import json
import subprocess
import sys
import time

sys.path.pop(0)  # this file's own directory: its name is the library's
import getfem
import numpy as np

getfem.util("trace level", 0)

# Pressure over this is how far a face yields to its condition; what is larger costs digits of the stresses.
PENALTY = 1e7
# Longest side over the shortest of all: GetFEM takes nodes that are much closer than elements are long for one.
SLENDER = 500.0

FLAT = "\n[punch]\ntype = \"flat\"\nhalf_width = 1.0\n[load]\nforce = 1.0\n[output]\npoints = 5\n"


def homogeneous(thickness, modulus, nu):
    return f"{{ thickness = {thickness}, poisson = {nu}, grading = {{ type = \"homogeneous\", modulus = {modulus} }} }}"


def stack(layers):
    sublayers = ", ".join(homogeneous(*layer) for layer in layers)
    return f"poisson = 0.3\ngrading = {{ type = \"stack\", layers = [{sublayers}] }}"


# Name; slipzone's layer; sublayers (thickness, modulus over the depth X(2), nu); half-length of the mesh.
# The half-plane is a block twenty thick on a rigid base in both programs.
COATED = [(1.5, 1.0, 0.3), (18.5, 5.0, 0.2)]
THREE = [(0.5, 1.0, 0.3), (1.0, 3.0, 0.25), (0.8, 0.5, 0.35)]
SCENES = [
    ("coating 1.5 b thick on a substrate 5 times as stiff", stack(COATED), COATED, 60.0),
    (
        "power law (1 + y/2)^2, 5 b thick, bonded to a rigid base",
        'thickness = 5.0\npoisson = 0.3\ngrading = { type = "power-law", surface = 1.0, length = 2.0, exponent = 2.0 }',
        [(5.0, "(1+X(2)/2)*(1+X(2)/2)", 0.3)],
        30.0,
    ),
    ("three layers bonded to a rigid base", stack(THREE), THREE, 20.0),
]


def crowded(length, first, ratio, largest, most):
    """Points from 0 to `length`, each step `ratio` times the last, up to `most` and `largest` times the distance plus 1."""
    points, step = [0.0], first
    while points[-1] + step < length:
        points.append(points[-1] + step)
        step = min(step * ratio, largest * (1.0 + points[-1]), most)
    points[-1 if length - points[-1] < 0.3 * step and len(points) > 1 else len(points):] = [length]
    return np.array(points)


def lines(layers, length, level):
    ratio, largest, smallest = 1.0 + 1.0 / 2**level, 0.3 / 2**level, 2.0**-level * 1e-3
    most = SLENDER * smallest
    inside = 1.0 - crowded(1.0, smallest, ratio, largest, most)[::-1]
    outside = 1.0 + crowded(length - 1.0, smallest, ratio, largest, most)[1:]
    ys = [np.array([0.0])]
    top = 0.0
    for thickness, _, _ in layers:
        # Interfaces turn corners of the strain only, and the first carries the edge.
        begin = smallest if top == 0.0 else 0.1 / 2**level
        ys.append(top + crowded(thickness, begin, ratio, largest, most)[1:])
        top += thickness
    return np.concatenate([inside, outside]), np.concatenate(ys)


def body(layers, length, level):
    """The meshed half of a layer, held in its middle and at its base: mesh, field, rule, stress, model. Region 1 is
    what lies under the punch."""
    xs, ys = lines(layers, length, level)
    mesh = getfem.Mesh("cartesian", xs, ys)
    faces, normals, centre = outer(mesh)
    regions = {
        1: (normals[1] < -0.5) & (centre[0] < 1.0),  # under the punch
        2: normals[0] < -0.5,  # the middle
        3: normals[1] > 0.5,  # the base
    }
    for number, chosen in regions.items():
        mesh.set_region(number, faces[:, chosen])
    field = getfem.MeshFem(mesh, 2)
    field.set_fem(getfem.Fem("FEM_QK(2,2)"))
    constant = getfem.MeshFem(mesh, 1)
    constant.set_fem(getfem.Fem("FEM_QK(2,0)"))
    rule = getfem.MeshIm(mesh, getfem.Integ("IM_GAUSS_PARALLELEPIPED(2,6)"))
    model = getfem.Model("real")
    model.add_fem_variable("u", field)
    tops = np.cumsum([0.0] + [t for t, _, _ in layers])
    which = np.searchsorted(tops, constant.basic_dof_nodes()[1]) - 1
    nus = np.array([nu for _, _, nu in layers])[which]
    if isinstance(layers[0][1], str):
        mu = layers[0][1]
    else:
        mu = "modulus"
        model.add_initialized_fem_data("modulus", constant, np.array([float(m) for _, m, _ in layers])[which])
    model.add_initialized_fem_data("k", constant, 2 * nus / (1 - 2 * nus))
    stress = f"({mu})*(2*Sym(Grad_u) + k*Div_u*Id(2))"
    model.add_linear_term(rule, f"({stress}):Grad_Test_u")
    # Multipliers would be dropped where elements are small.
    model.add_linear_term(rule, f"{PENALTY}*u(1)*Test_u(1)", 2)
    model.add_linear_term(rule, f"{PENALTY}*u.Test_u", 3)
    return mesh, field, rule, stress, model


def outer(mesh):
    """Faces on the boundary, their normals and centres."""
    faces = mesh.outer_faces()
    points = [mesh.pts(mesh.pid_in_faces(faces[:, [i]])) for i in range(faces.shape[1])]
    return faces, mesh.normal_of_faces(faces), np.array([p.mean(axis=1) for p in points]).T


def press(model, rule):
    """Pushes what lies under the punch in by 1."""
    model.add_linear_term(rule, f"{PENALTY}*u(2)*Test_u(2)", 1)
    model.add_source_term(rule, f"{PENALTY}*Test_u(2)", 1)


def solve(layers, length, level):
    mesh, field, rule, stress, model = body(layers, length, level)
    press(model, rule)
    model.solve("lsolver", "mumps")
    force = 2.0 * getfem.asm_generic(rule, 0, f"({stress}):Grad_u", -1, model)
    # Displacement is downwards and depth too: compression is negative all the same.
    corner = np.array([[1e-12], [1e-12]])
    centre = -np.ravel(model.interpolation(f"({stress})(2,2)", corner, mesh))[0]
    return force, centre / force, field.nbdof()


def slipzone(program, layer):
    started = time.perf_counter()
    scene = f"format = 1\n[layer]\n{layer}{FLAT}"
    done = subprocess.run([program, "solve", "-", "--json", "-"], input=scene, capture_output=True, text=True, check=False)
    result = json.loads(done.stdout)
    assert result["status"] == "converged", result["reason"]
    return 1.0 / result["load"]["indentation"], result["pressure"]["centre"], time.perf_counter() - started


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else "target/release/slipzone"
    most = int(sys.argv[2]) if len(sys.argv) > 2 else 2
    for name, layer, layers, length in SCENES:
        force, centre, spent = slipzone(program, layer)
        print(f"\n{name}\n  {'':24}{'force per depth':>18}{'p(0) b/P':>14}{'seconds':>10}"
              f"{'force off':>12}{'p(0) off':>12}{'extrap. off':>12}{'changed by':>12}")
        print(f"  {'slipzone, 1e-8':24}{force:18.10f}{centre:14.9f}{spent:10.3f}")
        last = None
        for level in range(most + 1):
            started = time.perf_counter()
            found, middle, unknowns = solve(layers, length, level)
            spent = time.perf_counter() - started
            off = f"{abs(found / force - 1):12.1e}{abs(middle / centre - 1):12.1e}"
            if last is not None:
                off += f"{abs((4 * found - last[0]) / 3 / force - 1):12.1e}{abs(found / last[0] - 1):12.1e}"
            print(f"  {f'GetFEM, {unknowns} unknowns':24}{found:18.10f}{middle:14.9f}{spent:10.3f}{off}")
            sys.stdout.flush()
            last = (found, middle)


if __name__ == "__main__":
    main()
