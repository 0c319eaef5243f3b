#!/usr/bin/python3
"""Packings of narrow and of wide spread: which are packed, and how well.   Usage: spreads.py BEADWORK [COUNT ...]

Each count of elements (500 where none is named) is packed with uniform and with Gaussian radii, of spread 0 to .9, in a box and in a
cylinder; the table of docs/theory/packing.md is that of 500 2000 8000 (some twenty minutes). Fails if one is refused for another reason than
that so few elements cannot have so many contacts.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

SPREADS = (0, 0.1, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.6, 0.7, 0.8, 0.9)
SHAPES = {"box": 'box="5 5 5 mm"', "cylinder": 'from="0 0 0 mm" to="0 0 10 mm" cylinder-radius="2.5 mm"'}
DECK = """<scene name="spread" seed="1">
  <fill>
    <free-filling   set="s" density="1000 kg/m^3" {shape} count="{count}" law="{law}" spread="{spread}"/>
    <forced-filling set="s" coordination="6.2"/>
    <relaxation     set="s" overlap="1e-7"/>
  </fill>
  <load><initial-velocity set="s" velocity="1 0 0 m/s"/></load>
  <move><verlet time-step="1 us" until="1"/></move>
</scene>
"""


def packed(beadwork, folder, **asked):
    """The figures of a packing; a text where it was refused."""
    (folder / "deck.xml").write_text(DECK.format(**asked))
    done = subprocess.run([beadwork, "run", "-q", folder / "deck.xml", "--out", folder / "run", "--overwrite", "--threads", "1"], capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        return done.stderr.splitlines()[0]
    return json.loads((folder / "run/summary.json").read_text())["packing"][-1]


def main():
    beadwork, counts = sys.argv[1], [int(c) for c in sys.argv[2:]] or [500]
    refused = 0
    print("| law | spread | in | elements | Z | without rattlers | in the bulk | rattlers | largest overlap |\n|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        for law in ("uniform", "truncated-gaussian"):
            for spread in SPREADS:
                for shape, attributes in SHAPES.items():
                    for count in counts:
                        p = packed(beadwork, Path(scratch), law=law, spread=spread, shape=attributes, count=count)
                        row = f"| {law} | {spread} | {shape} | {count} | "
                        if isinstance(p, str):
                            refused += "coordination number" not in p
                            print(row + p, flush=True)
                        else:
                            print(row + f"{p['coordination']:.2f} | {p['coordination_without_rattlers']:.2f} | {p.get('coordination_bulk', float('nan')):.2f} | "
                                  f"{p['rattlers']:.3f} | {p['max_overlap']:.1e} |", flush=True)
    sys.exit(f"{refused} refused" if refused else 0)


main()
