#!/usr/bin/python3
"""Building where the report page cannot be made. Each test states its requirement.

    no_page_test.py
"""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def cmake(*words, **environment):
    return subprocess.run(["cmake", *map(str, words)], capture_output=True, text=True, env={**os.environ, **environment}, timeout=900)


class NoPage(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def configure(self, *words):
        done = cmake("-S", ROOT, "-B", self.folder / "build", "-G", "Ninja", "-DFISSURA_TESTS=OFF", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout + done.stderr

    def bundle(self, **tools):
        """What cmake/bundle_page.cmake says with these programs, and the page it leaves."""
        page = self.folder / "page.html"
        done = cmake(f"-DSOURCE={ROOT}/report", f"-DBUILD={self.folder}/report", f"-DPAGE={page}",
                     *(f"-D{name}={tool}" for name, tool in tools.items()), "-P", ROOT / "cmake/bundle_page.cmake")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout + done.stderr, page.read_text()

    def test_switched_off(self):
        """-DFISSURA_PAGE=OFF configures, and says that this is why there will be no page."""
        self.assertIn("FISSURA_PAGE is off", self.configure("-DFISSURA_PAGE=OFF"))

    def test_without_node(self):
        """Where npm or node is missing, configuring says so and what to install, and succeeds."""
        for missing in ("NPM_PROGRAM", "NODE_PROGRAM"):
            self.assertIn("install nodejs and npm", self.configure(f"-D{missing}="))

    def test_bundling_without_npm_leaves_an_empty_page(self):
        """Without npm the build goes on with an empty page."""
        self.assertEqual(self.bundle()[1], "")

    def test_npm_that_fails_leaves_an_empty_page_and_a_warning(self):
        """npm without a network is a warning with what npm said, and the build goes on with an empty page."""
        npm = self.folder / "npm"
        npm.write_text("#!/bin/sh\necho no network here >&2\nexit 1\n")
        npm.chmod(0o755)
        said, page = self.bundle(NPM=npm, NODE="/bin/false")
        self.assertEqual(page, "")
        self.assertIn("no report page is built in", said)
        self.assertIn("no network here", said)


if __name__ == "__main__":
    unittest.main()
