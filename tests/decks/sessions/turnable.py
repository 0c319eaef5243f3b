"""The specimen of a report, in a real browser: it draws, turns, is cut, and shows the numbers that run.h5 holds.   Usage: turnable.py REPORT RUN

Needs Chromium and python3-websocket; says so, and skips, where there is none."""
import base64
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

import h5py
import numpy

SKIPPED = 77
report, run = map(Path, sys.argv[1:])
chromium = shutil.which("chromium") or shutil.which("chromium-browser")
try:
    import websocket
except ImportError:
    websocket = None
if not chromium or not websocket:
    print("skipped: chromium and python3-websocket are not installed", file=sys.stderr)
    sys.exit(SKIPPED)
if 'id="turnable"' not in report.read_text(encoding="utf-8"):
    print("skipped: three.js is not installed", file=sys.stderr)
    sys.exit(SKIPPED)


class Browser:
    """Chromium without a window, told what to do over its protocol."""

    def __init__(self, page, folder):
        self.process = subprocess.Popen(
            [chromium, "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--remote-debugging-port=0",
             "--remote-allow-origins=*", "--window-size=1200,900", f"--user-data-dir={folder}", page.as_uri()],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        for line in self.process.stderr:
            if found := re.search(r"ws://([^/]+)/", line):
                break
        target = next(each for each in json.load(urllib.request.urlopen(f"http://{found[1]}/json")) if each["type"] == "page")
        self.socket = websocket.create_connection(target["webSocketDebuggerUrl"], timeout=60)
        self.number = 0

    def tell(self, method, **parameters):
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": parameters}))
        while True:
            answer = json.loads(self.socket.recv())
            if answer.get("id") == self.number:
                assert "error" not in answer, answer
                return answer["result"]

    def ask(self, expression):
        result = self.tell("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in result, result
        return result["result"].get("value")

    def drawn(self):
        """The canvas as numbers, once the frame is there."""
        self.ask("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        url = self.ask("document.querySelector('#turnable canvas').toDataURL('image/png')")
        with tempfile.NamedTemporaryFile(suffix=".png") as file:
            file.write(base64.b64decode(url.split(",")[1]))
            file.flush()
            return file_pixels(Path(file.name))

    def mouse(self, kind, x, y, **more):
        self.tell("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def close(self):
        self.process.terminate()
        self.process.wait(20)


def file_pixels(path):
    import zlib

    raw = path.read_bytes()
    assert raw[:8] == b"\x89PNG\r\n\x1a\n"
    at, data = 8, b""
    while at < len(raw):
        length, kind = int.from_bytes(raw[at : at + 4], "big"), raw[at + 4 : at + 8]
        if kind == b"IHDR":
            width, height, depth, color = int.from_bytes(raw[at + 8 : at + 12], "big"), int.from_bytes(raw[at + 12 : at + 16], "big"), raw[at + 16], raw[at + 17]
        if kind == b"IDAT":
            data += raw[at + 8 : at + 8 + length]
        at += length + 12
    assert depth == 8 and color in (2, 6), (depth, color)
    each = 4 if color == 6 else 3
    rows = numpy.frombuffer(zlib.decompress(data), numpy.uint8).reshape(height, 1 + each * width)
    return rows  # filtered rows tell pictures apart as well


with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
    browser = Browser(report.resolve(), folder)
    try:
        for _ in range(100):
            if browser.ask("document.readyState") == "complete" and browser.ask("!!window.beadworkView || !!document.querySelector('#turnable.none')"):
                break
            time.sleep(0.1)
        assert browser.ask("!!window.beadworkView"), browser.ask("document.querySelector('#turnable .info').textContent")
        state = browser.ask("beadworkView.state()")
        with h5py.File(run / "run.h5") as record:
            frames = list(record["frames"])
            last = record["frames"][frames[-1]]
            elements = {name: last["elements"][name][:] for name in last["elements"]}
        assert state["elements"] == int((elements["radius"] > 0).sum()), state
        assert state["frame"] == len(frames) - 1, state

        # It draws, and turns under the mouse.
        browser.ask("document.querySelector('#turnable').scrollIntoView()")
        still = browser.drawn()
        assert len(set(still[len(still) // 2].tolist())) > 10, "nothing is drawn"
        area = browser.ask("(() => { const r = document.querySelector('#turnable canvas').getBoundingClientRect(); return [r.left, r.top, r.width, r.height]; })()")
        x, y = area[0] + area[2] / 2, area[1] + area[3] / 2
        browser.mouse("mousePressed", x, y, button="left", clickCount=1)
        for k in range(1, 11):
            browser.mouse("mouseMoved", x + 8 * k, y + 3 * k, button="left", buttons=1)
        browser.mouse("mouseReleased", x + 80, y + 30, button="left", clickCount=1)
        turned = browser.ask("beadworkView.state()")["quaternion"]
        angle = 2 * math.degrees(math.acos(min(1, abs(sum(a * b for a, b in zip(turned, state["quaternion"], strict=True))))))
        assert 20 < angle < 60, angle
        assert (browser.drawn() != still).any(), "it does not turn"

        # A click tells the numbers of the element that is hit.
        browser.ask("document.querySelector('#turnable [data-along=z]').click()")
        browser.drawn()
        browser.mouse("mousePressed", x, y, button="left", clickCount=1)
        browser.mouse("mouseReleased", x, y, button="left", clickCount=1)
        text = browser.ask("document.querySelector('#turnable .info').textContent")
        found = re.match(r"element (\d+) at \(([^)]*)\) (\S+), radius (\S+) ", text)
        assert found, text
        row = list(elements["id"]).index(int(found[1]))
        factor = {"m": 1, "mm": 1e-3, "µm": 1e-6, "nm": 1e-9}[found[3]]
        for shown, held in zip([*found[2].split(", "), found[4]], [*elements["position"][row], elements["radius"][row]], strict=True):
            assert abs(float(shown) * factor - held) < 1e-5 * abs(elements["position"]).max(), (text, held)
        displacement = float(re.search(r"length of displacement (\S+)", text)[1])
        assert abs(displacement - numpy.linalg.norm(elements["displacement"][row])) <= 1e-5 * displacement, text

        # Cut through the middle, the picture is another; and so is that of the first frame, and the one in colours of a field.
        whole = browser.drawn()
        for change in ("cut=x", "cut=no&frame=0", "cut=no&color=0"):
            for name, value in (each.split("=") for each in change.split("&")):
                browser.ask(f"(() => {{ const c = document.querySelector('#turnable [name={name}]'); c.value = '{value}'; c.dispatchEvent(new Event('input')); }})()")
            other = browser.drawn()
            assert other.shape == whole.shape and (other != whole).any(), f"{change} changes nothing"
        assert browser.ask("beadworkView.state()")["frame"] == 0

        # Damaged bonds alone: as many as the record has in this frame.
        browser.ask("(() => { for (const [n, v] of [['frame', 1e6], ['what', 'cracks']]) { const c = document.querySelector(`#turnable [name=${n}]`); c.value = v; c.dispatchEvent(new Event('input')); } })()")
        with h5py.File(run / "run.h5") as record:
            families = record["frames"][frames[-1]]["bonds"]
            damaged = sum(int((families[name]["state"][:] > 0).sum()) for name in families)
        assert damaged > 0 and browser.ask("beadworkView.state()")["bonds"] == damaged, (browser.ask("beadworkView.state()"), damaged)
    finally:
        browser.close()
