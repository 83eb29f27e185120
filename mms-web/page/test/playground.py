"""Uses the built page as a visitor does, in Chromium: python playground.py FILE.html MMS [--pictures FOLDER]

MMS is the command of this project: it makes results to judge, and the numbers that the page must show bit for bit. Code that
is shown needs gcc as well. Chromium is /usr/bin/chromium, or the path in the environment variable CHROMIUM.
"""

import argparse
import io
import json
import os
import pathlib
import re
import subprocess
import tempfile
import zipfile

from playwright.sync_api import expect, sync_playwright

FIELD = pathlib.Path(__file__).parents[3] / "fields" / "bar_1d.toml"
LONG = 60_000  # milliseconds that a slow machine may take


def command(*words, folder=None):
    """Runs a command, and returns what it prints."""
    return subprocess.run(words, cwd=folder, check=True, capture_output=True, text=True).stdout


class Visit:
    """One visitor: a browser page, and what it has asked the network for."""

    def __init__(self, browser, html, prepare=None, **options):
        self.context = browser.new_context(accept_downloads=True, **options)
        self.page = self.context.new_page()
        self.requests, self.complaints = [], []
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.on("console", lambda message: message.type == "error" and self.complaints.append(message.text))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        if prepare:
            prepare(self.page)
        self.html = html

    def open(self, fragment=""):
        self.page.goto(f"file://{self.html.resolve()}{fragment}")
        return self

    def verdict(self, text):
        expect(self.page.locator("#panel-check")).not_to_have_class(re.compile("stale"), timeout=LONG)
        expect(self.page.locator("#panel-check .verdict")).to_contain_text(text, timeout=LONG)

    def type_field(self, text):
        self.page.locator("#editor .cm-content").click()
        self.page.keyboard.press("Control+a")
        self.page.keyboard.insert_text(text)

    def choose(self, name):
        self.page.locator("#gallery").select_option(name)

    def tab(self, title):
        self.page.get_by_role("tab", name=title).click()
        expect(self.page.locator(f"#panel-{title.lower()}")).not_to_have_class(re.compile("stale"), timeout=LONG)

    def close(self):
        outside = [url for url in self.requests if not url.startswith(("file:", "blob:", "data:"))]
        assert not outside, f"the page asked for {outside}"
        assert sum(url.startswith("file:") for url in self.requests) == 1, self.requests
        assert not self.complaints, self.complaints
        self.context.close()


def writes(visit):
    """Types a field, breaks it, mends it at the place of the message."""
    text = FIELD.read_text()
    visit.type_field(text.replace("amplitude*cos", "amplitud*cos"))
    visit.verdict("The field has 1 mistake")
    message = visit.page.locator("#messages-list button")
    expect(message).to_contain_text("line 14, column 6: unknown name `amplitud`")
    expect(message).to_contain_text("did you mean `amplitude`?")
    expect(visit.page.locator(".cm-lintRange-error")).to_have_text("amplitud")
    message.focus()
    visit.page.keyboard.press("Enter")
    visit.page.keyboard.insert_text("amplitude")
    visit.verdict("The field passes")
    expect(visit.page.locator("#messages-count")).to_have_text("No mistakes")


def completes(visit):
    """Takes a claim from the list that the schema gives."""
    text = FIELD.read_text()
    visit.type_field(text[: text.index("x_max =")] + 'x_max = "f')
    visit.page.keyboard.press("Control+Space")
    options = visit.page.locator(".cm-tooltip-autocomplete li")
    expect(options.first).to_be_visible()
    assert {"fixed", "free"} <= set(options.all_text_contents()), options.all_text_contents()
    visit.page.keyboard.press("Escape")
    visit.type_field(text)
    visit.verdict("The field passes")


def derives(visit):
    """Reads the derivation in MathML."""
    visit.tab("Derivation")
    expect(visit.page.locator("#panel-derivation math").nth(5)).to_be_attached()


def moves(visit, mms):
    """Clicks the body, and compares each number with the command's, on three fields."""
    page = visit.page
    for name in ("bar_1d", "sheared_block_2d", "twisted_column"):
        visit.choose(name)
        visit.tab("Motion")
        canvas = page.locator("canvas")
        colours = canvas.evaluate(
            "c => new Set(new Uint32Array(c.getContext('2d').getImageData(0, 0, c.width, c.height).data.buffer)).size"
        )
        assert colours > 10, f"{name}: the drawing has {colours} colours"
        box = canvas.bounding_box()
        canvas.click(position={"x": box["width"] / 2, "y": 30 if name == "bar_1d" else box["height"] / 2})
        rows = page.locator("#panel-motion .scroll > table > tbody > tr")
        expect(rows.first).to_be_visible(timeout=LONG)
        inputs = page.locator("#panel-motion form input")
        *place, time = [inputs.nth(index).input_value() for index in range(inputs.count())]
        point = json.loads(command(mms, "eval", name, f"--at={','.join(place)}", "--time", time, "--json"))["points"][0]
        seen = {}
        for row in rows.all():
            cells = row.locator(".matrix td").all_text_contents()
            seen[row.locator("th").text_content().replace(" ", "_")] = [float(cell) for cell in cells]
        for quantity in ("displacement", "deformation_gradient", "first_piola_kirchhoff", "body_force"):
            assert seen[quantity] == point[quantity], f"{name}, {quantity}: {seen[quantity]} and not {point[quantity]}"


def takes_code(visit):
    """Takes the C code as a zip, builds its check program, and runs it."""
    page = visit.page
    visit.choose("bar_1d")
    visit.tab("Code")
    page.get_by_label("Language").select_option("c")
    page.locator("#panel-code summary").click()
    page.locator("#panel-code input[value=body_force]").check()
    expect(page.locator("#panel-code summary")).to_have_text("Quantities: body_force")
    expect(page.locator("#panel-code .command")).to_contain_text("bar_1d_check.c", timeout=LONG)
    expect(page.locator("#panel-code")).not_to_have_class(re.compile("stale"))
    with page.expect_download() as taken:
        page.get_by_role("button", name="All files (zip)").click()
    with tempfile.TemporaryDirectory() as folder:
        zipfile.ZipFile(io.BytesIO(pathlib.Path(taken.value.path()).read_bytes())).extractall(folder)
        line = page.locator("#panel-code .command").text_content()
        print(command("sh", "-c", line[line.index("cc ") :], folder=f"{folder}/bar_1d").strip())


def judges(visit, mms):
    """Chooses three files of results, and reads the verdict."""
    page = visit.page
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for cells in (8, 16, 32):
            target = pathlib.Path(folder, f"bar{cells}")
            command(mms, "run", "bar_1d", "--cells", str(cells), "--frames", "1", "--vtk", str(target))
            files.append(target.with_suffix(".vtu"))
            max(target.glob("*.vtu")).rename(files[-1])
        page.get_by_role("tab", name="Judge").click()
        page.locator("#results").set_input_files([str(file) for file in files])
        page.get_by_label("Quantities", exact=False).last.fill("u")
        page.get_by_role("button", name="Judge", exact=True).click()
        wanted = command(mms, "judge", "bar_1d", *map(str, files), "--quantity", "u")
    first = next(line for line in wanted.splitlines() if line.startswith("pass: "))
    expect(page.locator("#panel-judge .verdict")).to_have_text(first, timeout=LONG)
    expect(page.locator("#panel-judge figure img")).to_be_visible()
    assert page.locator("#panel-judge figure img").evaluate("image => image.naturalWidth") > 0


def judges_a_table(visit):
    """Drops a table of errors, and reads the verdict."""
    page = visit.page
    page.reload()
    visit.requests.pop()
    visit.verdict("The field passes")
    page.get_by_role("tab", name="Judge").click()
    table = "h,l2\n0.1,1.2e-3\n0.05,3.02e-4\n0.025,7.6e-5\n0.0125,1.9e-5\n"
    transfer = page.evaluate_handle(
        "table => { const data = new DataTransfer(); data.items.add(new File([table], 'errors.csv')); return data; }", table
    )
    page.dispatch_event("#panel-judge .drop", "drop", {"dataTransfer": transfer})
    page.get_by_label("The files are").select_option("errors")
    page.get_by_role("button", name="Judge", exact=True).click()
    expect(page.locator("#panel-judge .verdict")).to_contain_text("pass: observed order", timeout=LONG)


def shares(browser, visit, prepare):
    """Opens the link of a field, and finds the same text."""
    page = visit.page
    text = FIELD.read_text().replace("Body force on a 1D bar", "A bar of mine, λ = 0")
    visit.type_field(text)
    page.get_by_role("button", name="Share").click()
    link = page.locator("#link").input_value()
    page.keyboard.press("Escape")
    other = Visit(browser, visit.html, prepare).open("#" + link.split("#")[1])
    other.verdict("The field passes")
    expect(other.page.locator("#panel-check")).to_contain_text("A bar of mine, λ = 0")
    other.close()


def makes_a_new_field(visit):
    """Writes a template of a ring."""
    page = visit.page
    page.get_by_role("button", name="New field").click()
    page.get_by_label("Shape").select_option("annulus")
    page.get_by_role("button", name="Write it").click()
    expect(page.locator("#editor .cm-content")).to_contain_text("annulus")
    visit.verdict("The field passes")


def cancels(visit):
    """Cancels the check of a large field; the page answers the next one."""
    page = visit.page
    page.evaluate(
        """() => new MutationObserver((_, observer) => {
            observer.disconnect();
            document.getElementById("cancel").click();
        }).observe(document.getElementById("working"), { attributes: true })"""
    )
    visit.choose("twisted_column")
    expect(page.locator("#working")).to_be_hidden()
    expect(page.locator("#status")).to_have_text("Cancelled")
    visit.choose("bar_1d")
    visit.verdict("The field passes")


def works_by_keyboard(visit):
    """Goes through the tabs by arrows."""
    page = visit.page
    page.get_by_role("tab", name="Check").focus()
    for title in ("Derivation", "Motion", "Code", "Judge", "Check"):
        page.keyboard.press("ArrowRight")
        expect(page.get_by_role("tab", name=title)).to_be_focused()
        expect(page.locator(f"#panel-{title.lower()}")).to_be_visible()


def take_pictures(browser, html, folder, prepare):
    """Takes a picture of each tab, at two sizes, in light and dark."""
    folder.mkdir(parents=True, exist_ok=True)
    for width, height in ((1280, 900), (400, 800)):
        for scheme in ("light", "dark"):
            size = {"width": width, "height": height}
            visit = Visit(browser, html, prepare, viewport=size, color_scheme=scheme, reduced_motion="reduce").open()
            visit.verdict("The field passes")
            page = visit.page
            for title in ("Check", "Derivation", "Motion", "Code", "Judge"):
                visit.tab(title)
                page.screenshot(path=folder / f"{title.lower()}-{width}-{scheme}.png", full_page=width < 800)
            visit.close()


def main(prepare=None):
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("html", type=pathlib.Path)
    options.add_argument("mms", type=pathlib.Path)
    options.add_argument("--pictures", type=pathlib.Path)
    chosen = options.parse_args()
    mms = str(chosen.mms.resolve())
    with sync_playwright() as playwright:
        executable = os.environ.get("CHROMIUM", "/usr/bin/chromium")
        browser = playwright.chromium.launch(executable_path=executable, args=["--no-sandbox"])
        visit = Visit(browser, chosen.html, prepare).open()
        visit.verdict("The field passes")
        shown = visit.page.evaluate("Math.round(performance.now())")
        print(f"first check of bar_1d: {shown} ms after the page was opened")
        writes(visit)
        completes(visit)
        derives(visit)
        works_by_keyboard(visit)
        moves(visit, mms)
        takes_code(visit)
        judges(visit, mms)
        shares(browser, visit, prepare)
        makes_a_new_field(visit)
        cancels(visit)
        judges_a_table(visit)
        visit.close()
        if chosen.pictures:
            take_pictures(browser, chosen.html, chosen.pictures, prepare)
        browser.close()
    print("the page does what its visitors need, and asks the network for nothing")


if __name__ == "__main__":
    main()
