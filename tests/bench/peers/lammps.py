"""The disk law of Isostat in LAMMPS: data files, pair styles, and how its logs are read.

Mapping of the law (Gilabert 2007, Eqs. 4-10) on `pair_style granular`, units a = m = 1:

| Isostat                           | LAMMPS                                  | left over                                        |
| --------------------------------- | --------------------------------------- | ------------------------------------------------ |
| N = K_N overlap                   | normal hooke K_N                        |                                                  |
| zeta 2 sqrt(K_N m_eff), Eq. 6     | damping tsuji, alpha(e) = 2 zeta        | exact: alpha sqrt(K_N m_eff), e from the polynomial |
| K_T, mu, limit on elastic N       | tangential linear_history K_T 0 mu      | the limit there is mu |N with the viscous part|  |
| K_r theta, limit mu_r N           | rolling sds k 0 mu_roll                 | LAMMPS: force k (R_eff theta), torque R_eff x    |
|                                   |                                         | force, so K_r = k R_eff^2 and mu_r = mu_roll     |
|                                   |                                         | R_eff, with R_eff = R_i R_j / (R_i + R_j) of the |
|                                   |                                         | pair: matched at the mean R_eff                  |
| mass d^2, inertia m R^2 / 2       | density 6 / (pi d), fix nve/sphere disc | LAMMPS makes a mass of a sphere's volume         |
"""
import math
import os
import re
import subprocess

K_N, ZETA, MU = 1e5, 0.8, 0.5
K_R, MU_R = 1e-4 * K_N, 0.01 * MU      # [F0 a], [a]; a = 1
TIME_STEP = 0.06 / math.sqrt(K_N)      # c sqrt(m / K_N), m the mass of the largest disk


def tsuji_alpha(e):
    """alpha(e) of `damping tsuji` (Tsuji 1992), which LAMMPS evaluates for the restitution it is given."""
    return sum(c * e**n for n, c in enumerate((1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218)))


def tsuji_restitution(zeta):
    """The argument e with alpha(e) = 2 zeta: a handle on the damping, not the true restitution; negative past .6364."""
    low, high = -0.5, 1.0
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if tsuji_alpha(middle) > 2 * zeta else (low, middle)
    return (low + high) / 2


def mean_effective_radius(radii):
    """<R_i R_j / (R_i + R_j)> over independent pairs of the sample (every 7th grain: enough for 3 digits)."""
    some = radii[::7]
    return sum(a * b / (a + b) for a in some for b in some) / len(some) ** 2


def pair_style(law, radii, stiffness=K_N, friction=MU):
    """The pair_style and pair_coeff lines of `law`: rolling, granular (no rolling), history (gran/hooke/history)."""
    mass = 1.0
    if law == "history":
        # Its damping is gamma_n m_eff v_n with one gamma_n for all pairs: critical fraction zeta for two unit masses.
        gamma = ZETA * 2 * math.sqrt(stiffness / (mass / 2))
        return [f"pair_style gran/hooke/history {stiffness} {stiffness} {gamma} 0.0 {friction} 0", "pair_coeff * *"]
    line = (f"pair_coeff * * hooke {stiffness} {tsuji_restitution(ZETA):.15g} damping tsuji "
            f"tangential linear_history {stiffness} 0.0 {friction}")
    if law == "rolling":
        reff = mean_effective_radius(radii)
        k_r, mu_r = 1e-4 * stiffness, 0.01 * friction
        line += f" rolling sds {k_r / reff**2:.15g} 0.0 {mu_r / reff:.15g}"
    return ["pair_style granular", line]


def write_data(path, cell, grains, velocities=None):
    """A LAMMPS data file for atom_style sphere: disks of mass d^2 (units a, m)."""
    with open(path, "w") as file:
        file.write(f"disks\n\n{len(grains)} atoms\n1 atom types\n\n0 {cell[0]:.17g} xlo xhi\n0 {cell[1]:.17g} ylo yhi\n"
                   "-0.5 0.5 zlo zhi\n\nAtoms # sphere\n\n")
        for n, (_, x, y, r) in enumerate(grains, 1):
            file.write(f"{n} 1 {2 * r:.17g} {6 / (math.pi * 2 * r):.17g} {x % cell[0]:.17g} {y % cell[1]:.17g} 0\n")
        if velocities:
            file.write("\nVelocities\n\n")
            for n, (vx, vy, omega) in enumerate(velocities, 1):
                file.write(f"{n} {vx:.17g} {vy:.17g} 0 0 0 {omega:.17g}\n")


def run(script, cwd, law_lines, **variables):
    """Runs the input file `script` on one rank in directory `cwd`, with the law in the file pair.in; returns its log."""
    with open(os.path.join(cwd, "pair.in"), "w") as file:
        file.write("\n".join(law_lines) + "\n")
    command = ["lmp", "-in", script, "-log", "none"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    path = os.path.join(cwd, "log.lammps")
    with open(path, "w") as log:
        process = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, cwd=cwd,
                                 env={"PATH": "/usr/bin:/bin", "OMP_NUM_THREADS": "1", "HOME": cwd})
    with open(path) as log:
        said = log.read()
    if process.returncode != 0 or "ERROR" in said:
        raise RuntimeError(f"{' '.join(command)} failed:\n{said[-4000:]}")
    return said


def loops(log):
    """(steps, atoms, CPU seconds) of every run in a log: loop time times the share of the CPU it had."""
    times = re.findall(r"Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", log)
    shares = re.findall(r"([\d.]+)% CPU use", log)
    if len(times) != len(shares):
        raise RuntimeError("a run without its CPU share in the log")
    return [(int(steps), int(atoms), float(seconds) * float(share) / 100)
            for (seconds, steps, atoms), share in zip(times, shares)]
