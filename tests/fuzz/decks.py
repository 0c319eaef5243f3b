#!/usr/bin/python3
"""Changes decks as one who knows their structure, and has the program check, plan or run them for a few steps. It may refuse them, with a place and
a reason; a signal, a hang, a code that no error has, or an error without a place is a finding.
Usage: decks.py BEADWORK FOLDER... [--seconds S] [--seed N] [--found FOLDER] [--rounds N]"""
import argparse
import random
import re
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ET
from pathlib import Path

CODES = {"check": {0, 2, 4}, "plan": {0, 2, 3, 4}, "run": {0, 2, 3, 4}}
PATIENCE = 60  # seconds
NUMBERS = ["0", "-1", "1e308", "-1e308", "1e-308", "nan", "inf", "1e400", "0x10", "1,5", "9223372036854775808", "0.1.2", "-0", "1e-400", ""]
UNITS = ["mm", "um", "N", "N/mm^3", "GPa", "s", "kg", "percent", "m^-1", "parsec", "mm mm", "1/0"]
TEXTS = ["${", "${}", "${nothing}", "${1/0}", "${seed}", "all", "all all", ";", "=", "a = b; a = b", "../../../etc/passwd", "x < 1 mm", "x <", "\u00b5m",
         "\U0001F9F1", "'\"<>&", "$(touch /tmp/x)", "%s%n", "a" * 5000, "1 to 3", "3 to 1", "(" * 300, "-" * 300 + "1", "1 2 3 mm", "0 s 0 m/s, 1 s"]


def nodes_of(root):
    return [(parent, child) for parent in root.iter() for child in parent]


class Changes:
    def __init__(self, chance, pool):
        self.chance, self.pool = chance, pool  # pool: elements of all decks

    def value(self, text):
        chance = self.chance
        kind = chance.randrange(6)
        if kind == 0:
            return chance.choice(NUMBERS) + " " + chance.choice(UNITS)
        if kind == 1:
            return chance.choice(TEXTS)
        if kind == 2 and (found := list(re.finditer(r"[-+0-9.]+(e[-+]?[0-9]+)?", text))):
            at = chance.choice(found)
            return text[: at.start()] + chance.choice(NUMBERS) + text[at.end():]
        if kind == 3:
            return " ".join(reversed(text.split(" ")))
        if kind == 4 and text:
            k = chance.randrange(len(text))
            return text[:k] + text[k + 1:]
        return text + " " + text

    def attribute(self, root):
        element = self.chance.choice(list(root.iter()))
        if element.attrib:
            name = self.chance.choice(list(element.attrib))
            element.set(name, self.value(element.get(name)))

    def drop_attribute(self, root):
        element = self.chance.choice(list(root.iter()))
        if element.attrib:
            del element.attrib[self.chance.choice(list(element.attrib))]

    def lend_attribute(self, root):
        element, other = self.chance.choice(list(root.iter())), self.chance.choice(self.pool)
        if other.attrib:
            name = self.chance.choice(list(other.attrib))
            element.set(name, other.get(name))

    def drop(self, root):
        if pairs := nodes_of(root):
            parent, child = self.chance.choice(pairs)
            parent.remove(child)

    def twice(self, root):
        if pairs := nodes_of(root):
            parent, child = self.chance.choice(pairs)
            parent.append(child)

    def graft(self, root):
        element, other = self.chance.choice(list(root.iter())), self.chance.choice(self.pool)
        element.append(ET.fromstring(ET.tostring(other)))

    def move(self, root):
        if pairs := nodes_of(root):
            parent, child = self.chance.choice(pairs)
            new = self.chance.choice([e for e in root.iter() if child not in e.iter() or e is root])
            if new is not child and new not in list(child.iter()):
                parent.remove(child)
                new.append(child)

    def apply(self, root):
        kinds = [self.attribute] * 4 + [self.drop_attribute, self.lend_attribute, self.drop, self.twice, self.graft, self.move]
        for _ in range(self.chance.choice([1, 1, 1, 2, 2, 3, 5])):
            self.chance.choice(kinds)(root)


def damaged_text(chance, text):
    """Now and then what is no XML any more."""
    if chance.random() < 0.9:
        return text
    k = chance.randrange(len(text))
    return chance.choice([text[:k], text[:k] + chr(chance.randrange(1, 0x2FF)) + text[k:], text[:k] + text[k + 20:]])


def verdict(verb, command):
    try:
        done = subprocess.run(command, capture_output=True, timeout=PATIENCE, check=False)
    except subprocess.TimeoutExpired:
        return None if verb == "run" else f"no end within {PATIENCE} s"  # it may well compute
    said = (done.stdout + done.stderr).decode("utf-8", "replace")
    if done.returncode not in CODES[verb] or "Sanitizer" in said:
        return f"exit code {done.returncode}: {said[-600:]}"
    if done.returncode == 2 and "error" not in said:
        return f"refused without a word: {said[-300:]}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("beadwork")
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--rounds", type=int, default=10**9)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--found", type=Path)
    arguments = parser.parse_args()
    chance = random.Random(arguments.seed)
    decks = []
    for path in sorted(deck for folder in arguments.folders for deck in folder.rglob("*.xml")):
        try:
            decks.append((path, ET.parse(path).getroot()))
        except ET.ParseError:
            continue
    pool = [element for _, root in decks for element in root.iter()]
    changes = Changes(chance, pool)
    began, rounds, found = time.monotonic(), 0, 0
    with tempfile.TemporaryDirectory() as folder:
        while time.monotonic() - began < arguments.seconds and rounds < arguments.rounds:
            path, root = chance.choice(decks)
            root = ET.fromstring(ET.tostring(root))
            changes.apply(root)
            text = damaged_text(chance, ET.tostring(root, encoding="unicode"))
            deck = path.with_name(f".fuzz-{arguments.seed}-{path.name}")  # beside its includes
            deck.write_text(text, encoding="utf-8", errors="surrogatepass")
            try:
                small = len(text) < 4000
                verb = chance.choice(["check", "check", "plan", "run" if small else "plan"])
                more = ["--out", f"{folder}/out", "--overwrite", "--quiet"] if verb == "run" else []
                limit = ["timeout", "-s", "TERM", "5"] if verb == "run" else []
                wrong = verdict(verb, [*limit, arguments.beadwork, verb, str(deck), *more])
                if wrong and not (verb == "run" and wrong.startswith(("exit code 5", "exit code 124"))):
                    found += 1
                    print(f"{verb} {path.name}: {wrong}\n")
                    if arguments.found:
                        (arguments.found / f"deck-{arguments.seed}-{rounds}-{path.name}").write_text(text, encoding="utf-8", errors="surrogatepass")
            finally:
                deck.unlink(missing_ok=True)
            rounds += 1
    print(f"{rounds} decks changed, {found} findings")
    return found > 0


sys.exit(main())
