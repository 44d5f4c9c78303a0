#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws comments, identifiers and sentences of the docs at random, for the check that docs, comments and names need
one reading: give the output to a reader who does not know the project, and count what needed a second one.

  scripts/language_sample.py [--seed 1] [--count 100]
"""
import argparse
import pathlib
import random
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent


def sources(*endings):
    folders = [ROOT / "src", ROOT / "gallery/src"]
    return sorted(p for folder in folders for p in folder.rglob("*") if p.suffix in endings)


def comments():
    """Comments with the code that they describe: the first line below them, or the line that they end."""
    for path in sources(".h", ".cpp", ".js"):
        block, code_before = [], ""
        for line in path.read_text().split("\n"):
            text = line.strip()
            is_comment = text.startswith("//") and "SPDX" not in text and "clang-format" not in text
            continues = is_comment and (not code_before or text.startswith("///<"))
            if block and not continues:
                yield f"{path.relative_to(ROOT)}: {' '.join(block)}    [{code_before or text}]"
                block, code_before = [], ""
            if is_comment:
                block.append(text.lstrip("/< ").rstrip())
                continue
            code, mark, comment = text.partition("///<")
            block, code_before = ([comment.strip()], code.strip()) if mark else ([], "")


def comment_of(lines, number):
    """The comment of the declaration that begins in this line: above it, or at the end of its lines."""
    above = []
    for line in reversed(lines[:number]):
        if not line.strip().startswith(("///", "template")) or "///<" in line:
            break
        above.insert(0, line.strip().lstrip("/ ") if "///" in line else "")
    for line in lines[number : number + 6]:
        code, mark, comment = line.partition("///<")
        if mark:
            above.append(comment.strip())
        if mark or code.rstrip().endswith((";", "{", "}")):
            break
    return " ".join(text for text in above if text)


def identifiers():
    """Declarations in headers: file, enclosing classes, the whole declaration, and its comment."""
    declaration = re.compile(r"^\s*(?:class|struct|enum class|(?=\S)[\w:<>,&*\s\[\]]+?[\s&*])(\w{3,})\s*[({=;]")
    scope_start = re.compile(r"^(\s*)(?:class|struct|enum class) (\w+)[^;]*\{$")
    for path in sources(".h"):
        scopes = []  # (indentation, name) of the classes around the line; no name: of a function or a list
        text = path.read_text().split("\n")
        lines = [line.split("//")[0].rstrip() for line in text]
        for number, code in enumerate(lines):
            indentation = len(code) - len(code.lstrip())
            while code and scopes and indentation <= scopes[-1][0] and code.lstrip().startswith("}"):
                scopes.pop()
            before = lines[number - 1] if number else ""
            begins = not before or before.endswith((";", "{", "}", ":", ">"))  # no second line of a declaration
            is_local = any(name is None for _, name in scopes)
            match = declaration.match(code) if begins and not is_local else None
            if match and not code.lstrip().startswith(("#", "namespace", "return", "using", "}", "if", "for", "static_assert")):
                whole = code.strip()
                for following in lines[number + 1 : number + 6]:
                    if whole.endswith((";", "{", "}")):
                        break
                    whole += " " + following.strip()
                scope = "::".join(name for _, name in scopes)
                comment = comment_of(text, number)
                place = f"{path.relative_to(ROOT)}: {f'[in {scope}] ' if scope else ''}"
                yield f"{place}{whole}{f'    // {comment}' if comment else ''}"
            if code.endswith("{") and not code.startswith(("namespace", "extern")):
                start = scope_start.match(code)
                scopes.append((indentation, start[2] if start else None))


def sentences():
    """Sentences of the docs, without code blocks, formulas, tables and headings."""
    for path in [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]:
        prose = re.sub(r"```.*?```", "", path.read_text(), flags=re.S)
        for paragraph in re.split(r"\n\s*\n", prose):
            if re.match(r"\s*[#|!<]|    ", paragraph):
                continue
            lines = [re.sub(r"^\s*> ?", "", line) for line in paragraph.strip().split("\n")]  # quotations
            text = " ".join(re.sub(r"^\s*([-*]|\d+\.) ", "", line).strip() for line in lines)
            for sentence in re.split(r"(?<=[.!?]) +(?=[A-Z`\[])", text):
                if len(sentence.split()) > 4 and re.search(r"[.!?:][)*]*$", sentence):  # else a formula goes on
                    yield f"{path.relative_to(ROOT)}: {sentence}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=100)
    options = parser.parse_args()
    draw = random.Random(options.seed)
    kinds = [list(kind) for kind in (comments(), identifiers(), sentences())]
    for number in range(1, options.count + 1):
        print(f"{number}. {draw.choice(kinds[number % len(kinds)])}")


if __name__ == "__main__":
    main()
