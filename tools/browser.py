"""A headless Chromium through its debugging pipe, as much of it as looking at a page takes. Standard library only.

    with Browser() as browser:
        browser.open("runs/demo/report.html", until="window.fissura?.ready")
        browser.errors, browser.evaluate("document.title"), browser.screenshot("page.png")
"""
import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

PROGRAMS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
# WebGL is drawn by the processor; the sandbox needs rights that a container seldom gives to root.
OPTIONS = ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
           "--hide-scrollbars", "--no-first-run", "--disable-extensions", "--disable-background-networking", "--disable-component-update",
           "--force-device-scale-factor=1", "--remote-debugging-pipe")


class BrowserFailed(Exception):
    """No browser, or it did not do what it was asked in time."""


def find_browser():
    """Path of an installed Chromium, or None."""
    return next((path for path in map(shutil.which, PROGRAMS) if path), None)


class Browser:
    def __init__(self, width=1280, height=900, timeout=300):
        self.timeout, self.width, self.height = timeout, width, height
        program = find_browser()
        if not program:
            raise BrowserFailed("no Chromium: apt install chromium")
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_child, self.write_end = os.pipe()
        self.read_end, from_child = os.pipe()
        self.buffer, self.messages, self.number = b"", [], 0
        self.errors, self.requests = [], []
        # The browser reads commands from descriptor 3 and answers on 4; a shell puts the pipes there.
        command = [program, *OPTIONS, f"--user-data-dir={self.profile.name}", f"--window-size={width},{height}", "about:blank"]
        self.process = subprocess.Popen(["/bin/sh", "-c", f'exec "$@" 3<&{to_child} 4>&{from_child}', "browser", *command],
                                        pass_fds=(to_child, from_child), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_child)
        os.close(from_child)
        target = next(t for t in self.ask("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.ask("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.page(f"{domain}.enable")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        if self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        os.close(self.write_end)
        os.close(self.read_end)
        self.profile.cleanup()

    def page(self, method, **parameters):
        return self.ask(method, self.session, **parameters)

    def ask(self, method, session=None, **parameters):
        """Sends one command and waits for its answer; events on the way are taken note of."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        os.write(self.write_end, json.dumps(message).encode() + b"\0")
        end = time.monotonic() + self.timeout
        while True:
            answer = self.receive(end, method)
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise BrowserFailed(f"{method}: {answer['error']['message']}")
                return answer["result"]
            self.note(answer)

    def receive(self, end, method):
        while b"\0" not in self.buffer:
            ready, _, _ = select.select([self.read_end], [], [], max(0.0, end - time.monotonic()))
            data = os.read(self.read_end, 1 << 20) if ready else b""
            if not data:
                raise BrowserFailed(f"{method}: no answer within {self.timeout} s" if not ready else f"{method}: the browser has ended")
            self.buffer += data
        message, _, self.buffer = self.buffer.partition(b"\0")
        return json.loads(message)

    def note(self, event):
        """Errors of the console, and everything the page asks for."""
        kind, parameters = event.get("method"), event.get("params", {})
        if kind == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif kind == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "assert"):
            self.errors.append(" ".join(str(a.get("value", a.get("description", ""))) for a in parameters["args"]))
        elif kind == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            self.errors.append(parameters["entry"]["text"])
        elif kind == "Network.requestWillBeSent":
            self.requests.append(parameters["request"]["url"])

    def evaluate(self, expression):
        """The value of a JavaScript expression; promises are waited for."""
        result = self.page("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise BrowserFailed(result["exceptionDetails"].get("exception", {}).get("description", "an exception"))
        return result["result"].get("value")

    def open(self, path, until="document.readyState === 'complete'"):
        """Opens a file and waits until the expression is true; returns the seconds that took."""
        self.errors, self.requests = [], []
        start = time.monotonic()
        self.page("Page.navigate", url=Path(path).resolve().as_uri())
        while not self.evaluate(f"Boolean({until})"):
            if time.monotonic() - start > self.timeout:
                raise BrowserFailed(f"{path}: not ready after {self.timeout} s; the console says: {self.errors}")
            time.sleep(0.02)
        return time.monotonic() - start

    def screenshot(self, out, selector=None, full=False):
        """The window, the whole page, or one element of it, as a PNG."""
        options = {}
        if selector:
            box = self.evaluate(f"(() => {{ const r = document.querySelector({json.dumps(selector)}).getBoundingClientRect();"
                                "return {x: r.x + scrollX, y: r.y + scrollY, width: r.width, height: r.height, scale: 1}; })()")
            options = {"clip": box, "captureBeyondViewport": True}
        elif full:
            size = self.page("Page.getLayoutMetrics")["cssContentSize"]
            options = {"clip": {"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1}, "captureBeyondViewport": True}
        data = self.page("Page.captureScreenshot", format="png", **options)["data"]
        Path(out).write_bytes(base64.b64decode(data))

    def pdf(self, out):
        """The page as it prints."""
        Path(out).write_bytes(base64.b64decode(self.page("Page.printToPDF", printBackground=True, preferCSSPageSize=True)["data"]))
