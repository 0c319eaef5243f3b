"""What one bond of a deck does, by its curves.   Usage: law.py FOLDER beam|glue|others|kept|large|filled"""
import json
import math
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

folder = Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
families = summary["result"]

L, R, r = 2e-3, 1e-3, 0.5e-3  # distance, radius of the elements, of the beam
E, nu, strength = 100e9, 0.25, 500e6
A, I = math.pi * r**2, math.pi * r**4 / 4
J, G = 2 * I, E / (2 * (1 + nu))


def near(a, b, within):
    assert abs(a - b) <= within * abs(b), f"{a} is not {b} within {within}"


def curve(name):
    """Columns by name, with their units in the first line."""
    lines = (folder / "curves" / f"{name}.csv").read_text().splitlines()
    names = lines[0].split(",")
    return dict(zip(names, zip(*([float(cell) for cell in line.split(",")] for line in lines[1:]))))


def work(motion, load):
    return sum(0.5 * (load[k] + load[k - 1]) * (motion[k] - motion[k - 1]) for k in range(1, len(load)))


def all_of(family, wanted):
    modes = families[family]["modes"]
    assert set(modes) == set(wanted), set(modes)
    for name, mode in modes.items():
        drawn = sorted(path.name for path in (folder / "curves").glob(f"*-{name}.*") if path.name.startswith(family))
        assert len(drawn) == (0 if mode["peak"] == 0 else 3), drawn  # none of what bears nothing
        if drawn:
            picture = xml.parse(folder / mode["picture"]).getroot()
            assert picture.tag.endswith("svg") and f"{family}, {name}" in "".join(picture.itertext()), name


def beam():
    """Euler, Bernoulli and Saint-Venant, until the largest stress of the section is the strength."""
    modes = families["beam"]["modes"]
    all_of("beam", {"tension", "compression", "shear", "bending", "torsion"})
    for name, stiffness in {"tension": E * A / L, "compression": E * A / L, "shear": 12 * E * I / L**3, "bending": E * I / L, "torsion": G * J / L}.items():
        near(modes[name]["stiffness"], stiffness, 1e-6)
        near(modes[name]["stated_stiffness"], stiffness, 1e-9)
    pulled = curve("beam-tension")
    s, f = pulled["opening [m]"], pulled["force [N]"]
    onset = strength * L / E
    for opening, force in zip(s, f):
        if opening < 0.999 * onset and s.index(opening) < s.index(max(s)):
            assert abs(force - E * A / L * opening) < 1e-6 * strength * A, (opening, force)
    near(max(f), strength * A, 1e-5)  # its mean, though the deck has it scatter
    near(modes["tension"]["failed_at"], onset, 1e-5)
    near(modes["tension"]["dissipated"], 0.5 * strength * A * onset, 1e-4)  # what it held goes with it
    assert max(s) > 1.09 * onset and abs(f[-1]) < 1e-9 * max(f)
    near(modes["compression"]["peak"], -0.1 * E * A, 1e-5)  # it breaks by tension alone
    near(modes["bending"]["peak"], strength * I / r, 1e-4)
    twisted = curve("beam-torsion")  # normal stresses alone are judged: it never fails
    assert modes["torsion"]["failed_at"] is None and modes["torsion"]["dissipated"] < 1e-12
    for angle, torque in zip(twisted["twist [rad]"], twisted["torque [N.m]"]):
        assert abs(torque - G * J / L * math.sin(angle)) < 1e-9 * G * J / L, (angle, torque)
    near(max(twisted["twist [rad]"]), 0.2, 1e-6)


def glue():
    """Each mode takes its energy over the area of a contact, comes back to the origin, and goes on where it left off."""
    modes = families["glue"]["modes"]
    all_of("glue", {"tension", "compression", "shear", "bending", "torsion"})
    assert modes["torsion"]["peak"] == 0 and modes["bending"]["stiffness"] == 0  # faces meet in a point
    assert any("area" in note for note in families["glue"]["notes"]) and any("normal" in note for note in families["glue"]["notes"])
    S, energy = math.pi * R**2, 100
    for name, sigma, motion in (("tension", 10e6, "opening [m]"), ("shear", 20e6, "sliding [m]")):
        end = 2 * energy / sigma
        both = curve(f"glue-{name}")
        s, f = both[motion], both["force [N]"]
        near(modes[name]["stiffness"], sigma * S / (0.1 * end), 1e-4)
        near(modes[name]["stated_stiffness"], sigma * S / (0.1 * end), 1e-9)
        near(modes[name]["peak"], sigma * S, 0.005)
        near(modes[name]["failed_at"], end, 1e-4)
        near(modes[name]["dissipated"], energy * S, 1e-6)
        near(work(s, f), energy * S, 0.002)
        near(both["dissipated [J]"][-1], energy * S, 1e-6)
        back = [k for k in range(1, len(s)) if s[k] < s[k - 1] and s[k] > 0.02 * max(s)]
        slopes = {round(f[k] / s[k] / modes[name]["stiffness"], 5) for k in back}
        assert len(slopes) == 6, slopes  # six cycles, a straight line through the origin each; the last with nothing left
        assert min(slopes) == 0 and max(slopes) == 1, slopes
    pressed = curve("glue-compression")
    near(pressed["force [N]"][-2] / pressed["opening [m]"][-2], 10e6 * S / (0.1 * 2e-5), 1e-6)


def others():
    wire = families["wire"]["modes"]
    all_of("wire", {"tension", "compression", "shear"})
    assert any("no turns" in note for note in families["wire"]["notes"])
    near(wire["tension"]["stiffness"], 1e9 * math.pi * R**2 / L, 1e-6)
    assert wire["shear"]["stiffness"] == 0 == wire["shear"]["stated_stiffness"] and wire["tension"]["failed_at"] > 0
    touch = families["touch"]["modes"]
    all_of("touch", {"compression", "shear"})
    near(touch["compression"]["stiffness"], 1e6, 1e-6)
    assert touch["compression"]["dissipated"] < 1e-12
    near(abs(touch["shear"]["peak"]), 0.3 * 1e6 * 1e-3 * L, 0.01)  # Coulomb
    assert touch["shear"]["dissipated"] > 0
    page = (folder / "report.html").read_text()
    assert page.count("<figure") == 3 + 2 and "wire" in page and "no turns" in page, page.count("<figure")


def kept():
    """Laws that are shown once more come of what has been run; families that are not asked for are gone."""
    assert summary["runs"]["run"] == 0 and summary["runs"]["known"] == 6, summary["runs"]
    assert sorted(path.stem for path in (folder / "curves").glob("*.csv")) == ["wire-compression", "wire-shear", "wire-tension"]


def large():
    """Two elements of radii that are given, and a modulus; how far is given too, so that it does not come to fail."""
    wire = families["wire"]
    assert wire["radii"] == [2e-3, 4e-3] and wire["modes"]["tension"]["failed_at"] is None, wire
    near(wire["modes"]["tension"]["stiffness"], 2e9 * math.pi * 3e-3**2 / 6e-3, 1e-6)
    near(wire["modes"]["tension"]["reached"], 0.01 * 6e-3, 1e-6)
    glue = families["glue"]["modes"]
    for name in ("tension", "compression", "shear", "bending"):  # on unequal spheres half a turn each makes faces slide
        near(glue[name]["stiffness"], glue[name]["stated_stiffness"], 1e-4)
    near(glue["bending"]["stated_stiffness"], glue["shear"]["stated_stiffness"] * 1e-3**2, 1e-6)


def filled():
    """The mean over each of the two sets, where the fillings have several radii."""
    near(families["wire"]["radii"][0], 1e-3, 1e-12)
    near(families["wire"]["radii"][1], 2e-3, 1e-12)


{"beam": beam, "glue": glue, "others": others, "kept": kept, "large": large, "filled": filled}[sys.argv[2]]()
