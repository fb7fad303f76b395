#!/usr/bin/env python3
"""Finds dead links.

usage: check_links.py REPOSITORY [FOLDER_OF_HTML]

Of the repository: the Markdown files at the top, in docs/, examples/, stdlib/ and tests/. Every relative link must lead
to a file, and its #anchor to a heading; docs/README.md must link to every other page of docs/. Of the HTML folder: every link and its anchor; every id only once. Links to
other sites are not followed.
"""
import html.parser
import pathlib
import re
import sys


def slug(heading):
    """The anchor of a Markdown heading, as forges make it."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
    return re.sub(r"[^\w\- ]", "", text).strip().replace(" ", "-")


def markdown_parts(path):
    """(anchors, [(line number, link)]) of a Markdown file, without what stands in code."""
    anchors, links, fenced = set(), [], False
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
            continue
        if fenced:
            continue
        if heading := re.match(r"#+\s+(.*)", line):
            anchors.add(slug(heading.group(1)))
        text = re.sub(r"`[^`]*`", "", line)
        links += [(number, link) for link in re.findall(r"\]\(([^)\s]+)\)", text)]
    return anchors, links


def check_markdown(root):
    files = [p for pattern in ("*.md", "docs/**/*.md", "examples/**/*.md", "stdlib/**/*.md", "tests/**/*.md")
             for p in root.glob(pattern)]
    parts = {p.resolve(): markdown_parts(p) for p in files}
    errors, count = [], 0
    for path, (_, links) in parts.items():
        for number, link in links:
            if re.match(r"[a-z]+:", link):
                continue
            count += 1
            target, _, anchor = link.partition("#")
            goal = (path.parent / target).resolve() if target else path
            if not goal.exists():
                errors.append(f"{path.relative_to(root)}:{number}: {link}: there is no such file")
            elif anchor and goal in parts and anchor not in parts[goal][0]:
                errors.append(f"{path.relative_to(root)}:{number}: {link}: there is no such heading")
    return errors + missing_in_index(root / "docs", parts), count


def missing_in_index(docs, parts):
    """An error for each page of the folder that its index does not link to."""
    index = docs / "README.md"
    listed = {(docs / link.partition("#")[0]).resolve() for _, link in parts[index.resolve()][1]}
    pages = sorted(p for p in parts if p.is_relative_to(docs) and p not in listed and p != index.resolve())
    return [f"docs/README.md: there is no link to {p.relative_to(docs)}" for p in pages]


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.ids, self.links = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id":
                self.ids.append(value)
            elif name in ("href", "src"):
                self.links.append(value)


def check_html(folder):
    pages = {p.name: Page(p.read_text(encoding="utf-8")) for p in folder.glob("*.html")}
    errors = [] if pages else [f"{folder}: there are no pages"]
    count = 0
    for name, page in pages.items():
        errors += [f"{name}: the id {i} occurs twice" for i in sorted({i for i in page.ids if page.ids.count(i) > 1})]
        for link in page.links:
            count += 1
            target, _, anchor = link.partition("#")
            target = target or name
            if not (folder / target).exists() or anchor and anchor not in pages[target].ids:
                errors.append(f"{name}: {link} leads nowhere")
    # The search's links, too.
    for link in re.findall(r'^\["[^"]*","([^"]*)"', (folder / "search.js").read_text(encoding="utf-8"), re.M):
        count += 1
        target, _, anchor = link.partition("#")
        if target not in pages or anchor not in pages[target].ids:
            errors.append(f"search.js: {link} leads nowhere")
    return errors, count


def main():
    errors, count = check_markdown(pathlib.Path(sys.argv[1]).resolve())
    if len(sys.argv) > 2:
        more, links = check_html(pathlib.Path(sys.argv[2]))
        errors, count = errors + more, count + links
    print(*errors, f"{count} links, {len(errors)} dead", sep="\n")
    return 1 if errors or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
