"""Hooks of mkdocs.yml. Documents link to files of the repository, as they are read there as well: those files become pages of
the site, so that its links can be checked and nothing leads out of it. Formulas become MathML, which browsers draw themselves.
"""

import posixpath
import re
from html import unescape
from pathlib import Path

from latex2mathml.converter import convert
from mkdocs.structure.files import File

LINK = re.compile(r"(?<=\]\()([^)\s#:]+)(?=[)#])")
FORMULA = re.compile(r'<(span|div) class="arithmatex">\\[(\[](.*?)\\[)\]]</\1>', re.DOTALL)
HIDDEN = "---\nsearch: {exclude: true}\n---\n"
LANGUAGES = {".cpp": "cpp", ".hpp": "cpp", ".py": "python", ".yaml": "yaml", ".yml": "yaml"}


def repository_path(uri):
    """Where the page `uri` of the site lies in the repository."""
    return uri.removeprefix("repository/") if uri.startswith("repository/") else f"docs/{uri}"


def target_of(link, page):
    """The path in the repository that a link of the document at `page` leads to."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(page), link))


def site_uri(path):
    """The page or file of the site for a path in the repository; pages of what is no document end with .md as well."""
    if path.startswith("docs/"):
        return path.removeprefix("docs/")
    return f"repository/{path}" if path.endswith(".md") else f"repository/{path}.md"


def page_of(path, name):
    """The text of the page of a document, a source or a folder, None where there is no such thing."""
    if path.is_dir():
        names = sorted(entry.name + "/" * entry.is_dir() for entry in path.iterdir() if entry.name != "node_modules")
        return f"{HIDDEN}# {name}/\n\n" + "\n".join(f"* `{entry}`" for entry in names) + "\n"
    if not path.is_file():
        return None
    text = path.read_text()
    if path.suffix == ".md":
        return text
    return f"{HIDDEN}# {name}\n\n````{LANGUAGES.get(path.suffix, 'text')}\n{text}````\n"


def on_files(files, config):
    root = Path(config.config_file_path).parent
    documents = [(repository_path(file.src_uri), file.content_string) for file in files.documentation_pages()]
    while documents:
        place, text = documents.pop()
        for link in LINK.findall(text):
            path = target_of(link, place)
            uri = site_uri(path)
            page = None if path.startswith("docs/") or files.get_file_from_path(uri) else page_of(root / path, path)
            if page is None:
                continue
            files.append(File.generated(config, uri, content=page))
            if path.endswith(".md"):
                documents.append((path, page))
    return files


def on_page_markdown(markdown, page, config, files):
    here = page.file.src_uri
    place = repository_path(here)

    def moved(match):
        uri = site_uri(target_of(match[1], place))
        known = files.get_file_from_path(uri) is not None
        return posixpath.relpath(uri, posixpath.dirname(here)) if known else match[1]

    return LINK.sub(moved, markdown)


def on_page_content(html, page, config, files):
    return FORMULA.sub(lambda m: convert(unescape(m[2]), display="block" if m[1] == "div" else "inline"), html)
