#!/usr/bin/env python3
"""Opens the page of a batch in a browser. Usage: page_test.py PROGRAM"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

PROGRAM = os.path.abspath(sys.argv.pop(1))
BROWSER = shutil.which("chromium") or shutil.which("chromium-browser")

SCRIPT = r'''
local p = require("lissom").params{ height = { type = "number", default = 0 }, text = { type = "string",
    default = "" }, out = { type = "folder", default = "out" } }
assert(io.open(p.out .. "/a.svg", "w")):write('<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>'):close()
if p.height == 3 then error("on </script> purpose") end
'''

# Acts as a user would, and leaves what is seen in the title.
ACTS = r'''
<script>
const seen = { errors: [] };
window.onerror = text => { seen.errors.push(text); };
window.onload = () => setTimeout(() => {
    const rows = () => [...document.querySelectorAll("#body tr")].map(tr => [...tr.children].map(td => td.innerText));
    const type = text => { $("filter").value = text; $("filter").oninput(); };
    seen.first = rows().length;
    seen.pictures = document.querySelectorAll("#body img[loading=lazy]").length;
    [...$("head").children].find(th => th.dataset.column === "height").click();
    [...$("head").children].find(th => th.dataset.column === "height").click();
    seen.sorted = rows().slice(0, 3).map(row => row[columns.indexOf("height")]);
    type("height=7");
    seen.filtered = rows().map(row => row[columns.indexOf("height")]);
    type("");
    const press = label => [...document.querySelectorAll("#bar button")].find(b => b.innerText.startsWith(label)).click();
    seen.outcomes = [...$("outcomes").children].map(button => button.innerText);
    if (seen.outcomes.length) press("failed");
    seen.kept = new URLSearchParams(location.hash.slice(1)).get("outcome");
    seen.failed = rows().map(row => row[columns.indexOf("message")]);
    seen.log = document.querySelector("#body td.failed a").getAttribute("href");
    if (seen.outcomes.length) press("all");
    press("pictures");
    seen.cards = document.querySelectorAll("#grid figure img").length;
    seen.missing = [...document.querySelectorAll("#grid .none")].map(none => none.innerText);
    seen.wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
    document.body.textContent = "SEEN" + JSON.stringify(seen) + "SEEN";
}, 50);
</script>
'''


class Page(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="lissom-page-")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def shown(self, page, width=1400):
        run = subprocess.run(
            [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=5000", "--dump-dom",
             "--user-data-dir=" + self.path("profile"), f"--window-size={width},900", "file://" + page],
            capture_output=True, text=True, timeout=120, check=False)
        parts = run.stdout.split("SEEN")
        self.assertGreaterEqual(len(parts), 3, run.stdout[-500:] + run.stderr[-500:])
        return json.loads(parts[1].replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&"))

    def act(self, source, width=1400):
        with open(source, encoding="utf-8") as file:
            text = file.read()
        with open(self.path("out", "acted.html"), "w", encoding="utf-8") as file:
            file.write(text.replace("<script type", ACTS + "<script type", 1))
        return self.shown(self.path("out", "acted.html"), width)

    def test_the_page_sorts_filters_and_shows_pictures(self):
        with open(self.path("make.lua"), "w", encoding="utf-8") as file:
            file.write(SCRIPT)
        subprocess.run([PROGRAM, "batch", "make.lua", "--sweep", "height=0:11:1", "--set", "text=<b>&\"",
                        "--out", "out/{height}", "--retries", "0"], cwd=self.folder, check=False,
                       stdout=subprocess.DEVNULL)
        seen = self.act(self.path("out", "index.html"))
        self.assertEqual(seen["errors"], [])
        self.assertEqual(seen["first"], 12)
        self.assertEqual(seen["pictures"], 11)
        self.assertEqual(seen["sorted"], ["11", "10", "9"])
        self.assertEqual(seen["filtered"], ["7"])
        self.assertEqual(len(seen["failed"]), 1)
        self.assertIn("on </script> purpose", seen["failed"][0])
        self.assertTrue(os.path.exists(self.path("out", seen["log"])))
        self.assertEqual(seen["outcomes"], ["all 12", "done 11", "failed 1"])
        self.assertEqual(seen["kept"], "failed")
        self.assertEqual(seen["cards"], 11)
        # A failed job has its place among the pictures.
        self.assertEqual(len(seen["missing"]), 1)
        self.assertIn("purpose", seen["missing"][0])
        narrow = self.act(self.path("out", "index.html"), width=500)
        self.assertEqual((narrow["errors"], narrow["cards"], narrow["wide"]), ([], 11, 0))
        self.many(self.path("out", "index.html"))

    def test_a_contact_sheet_begins_with_its_pictures(self):
        with open(self.path("draw.lua"), "w", encoding="utf-8") as file:
            file.write(SCRIPT.replace('"folder", default = "out"', '"file", default = ""').replace(' .. "/a.svg"', ""))
        subprocess.run([PROGRAM, "batch", "draw.lua", "--sweep", "height=0:4:1", "--out", "out/a #1%20?/{height}.svg",
                        "--retries", "0"], cwd=self.folder, check=False, stdout=subprocess.DEVNULL)
        with open(self.path("out", "a #1%20?", "index.html"), encoding="utf-8") as file:
            page = file.read()
        acts = """<script>window.onload = () => setTimeout(() => {
            const images = [...document.querySelectorAll("#grid img")];
            const seen = { errors: [], cards: images.length, drawn: images.filter(i => i.naturalWidth > 0).length };
            document.body.textContent = "SEEN" + JSON.stringify(seen) + "SEEN"; }, 500);</script>"""
        with open(self.path("out", "a #1%20?", "acted.html"), "w", encoding="utf-8") as file:
            file.write(page.replace("<script type", acts + "<script type", 1))
        seen = self.shown(urllib.parse.quote(self.path("out", "a #1%20?", "acted.html")))
        self.assertEqual((seen["cards"], seen["drawn"]), (4, 4))

    def many(self, source):
        """The same page with 10,000 jobs draws no more than a few hundred at once."""
        with open(source, encoding="utf-8") as file:
            before, rest = file.read().split('id="data">', 1)
        data, after = rest.split("</script>", 1)
        page = json.loads(data)
        page["jobs"] = [dict(page["jobs"][i % 3], number=i + 1, arguments={"height": str(i), "text": "x"})
                        for i in range(10000)]
        with open(self.path("out", "many.html"), "w", encoding="utf-8") as file:
            file.write(before + 'id="data">' + json.dumps(page) + "</script>" + after)
        with open(self.path("out", "many.html"), encoding="utf-8") as file:
            text = file.read()
        self.assertLess(len(text), 8000000)
        acts = ACTS.replace('seen.log = document.querySelector("#body td.failed a").getAttribute("href");', "")
        with open(self.path("out", "many_acted.html"), "w", encoding="utf-8") as file:
            file.write(text.replace("<script type", acts + "<script type", 1))
        seen = self.shown(self.path("out", "many_acted.html"))
        self.assertEqual(seen["errors"], [])
        self.assertLessEqual(seen["first"], 600)
        self.assertEqual(seen["sorted"], ["9999", "9998", "9997"])
        self.assertEqual(seen["filtered"], ["7"])


if __name__ == "__main__":
    if not BROWSER:
        print("skipped: chromium is not installed")
        sys.exit(77)
    unittest.main()
