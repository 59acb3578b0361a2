"""check.py SOURCE_FOLDER WORK_FOLDER: every text of the interface is translated into every language of po/LINGUAS, and
each translation takes the values that the English text takes. What the editor's tables say that the engine says is in the
engine's sources."""

import gettext
import pathlib
import re
import subprocess
import sys

source, work = map(pathlib.Path, sys.argv[1:3])
work.mkdir(parents=True, exist_ok=True)
failures = []


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode != 0:
        failures.append(f"{' '.join(map(str, words))}:\n{done.stdout}{done.stderr}")


def values(text):
    """What a pattern takes: fields of fmt with their numbers, conversions of printf, and the id behind ## of ImGui."""
    fields, automatic = set(), 0
    bare = text.replace("{{", "").replace("}}", "")
    for number, _, form in re.findall(r"\{(\d*)(:((?:[^{}]|\{\})*))?\}", bare):
        fields.add((number or str(automatic), form))
        automatic += not number
        automatic += form.count("{}")
    printf = [c for c in re.findall(r"%[.0-9]*[a-z]+|%%", bare)]
    return fields, printf, re.findall(r"##.*", text)


pot = work / "acentric.pot"
run(source / "po/extract.sh", pot)
languages = (source / "po/LINGUAS").read_text().split()
table = re.findall(r'\{"(\w\w)", "', (source / "ui/translate.cpp").read_text(encoding="utf-8"))
if sorted(table) != sorted(languages + ["en"]):
    failures.append(f"po/LINGUAS has {languages}, the table of ui/translate.cpp {table}")
texts = 0
for language in languages:
    po, mo = source / f"po/{language}.po", work / f"{language}.mo"
    run("msgfmt", "--check", "-o", mo, po)
    run("msgcmp", po, pot)  # finds what is untranslated, fuzzy or missing
    if not mo.is_file():
        continue
    with mo.open("rb") as stream:
        catalogue = gettext.GNUTranslations(stream)._catalog
    plurals = re.findall(r'msgid "(.*)"\nmsgid_plural "(.*)"\n((?:msgstr\[\d\] ".*"\n)+)', po.read_text(encoding="utf-8"))
    for one, many, forms in plurals:
        known = values(one)[0] | values(many)[0]
        for form in re.findall(r'"(.*)"', forms):
            if not values(form)[0] <= known:
                failures.append(f"{language}: {many!r} and {form!r} take different values")
    for english, translation in catalogue.items():
        if not english:
            continue
        texts += 1
        text = english[0] if isinstance(english, tuple) else english
        text = text.split("\x04")[-1]
        if values(text) != values(translation) and not isinstance(english, tuple):
            failures.append(f"{language}: {text!r} and {translation!r} take different values")
        if text[:1].isspace() != translation[:1].isspace() and text[:1] == "\n":
            failures.append(f"{language}: {translation!r} shall begin a line as {text!r} does")


def sources(folder, *suffixes):
    return [path.read_text(encoding="utf-8") for path in sorted((source / folder).rglob("*")) if path.suffix in suffixes]


def literals(text):
    """Texts in quotes, adjacent ones joined."""
    one = r'"(?:[^"\\\n]|\\.)*"'
    return ["".join(part[1:-1] for part in re.findall(one, found)) for found in re.findall(rf"{one}(?:\s*{one})*", text)]


def pieces(text):
    """The words between the values of a pattern, without the place before them."""
    text = re.sub(r"\{\d*(:(?:[^{}]|\{[^{}]*\})*)?\}", "\0", re.sub(r"^(/\S*: |: )", "", text))
    return [tuple(words) for piece in text.split("\0") if (words := re.findall(r"\w+(?:['’.-]\w+)*|[^\w\s\\\"]", piece))]


def made_of(words, known):
    """Whether the words are pieces of known texts one after the other."""
    reached = {0}
    for start in range(len(words)):
        if start in reached:
            reached |= {end for end in range(start + 1, len(words) + 1) if words[start:end] in known}
    return len(words) in reached


said = {piece for text in sources("engine", ".cpp", ".h") for literal in literals(text) for piece in pieces(literal)}
tables = 0
for text in [path.read_text(encoding="utf-8") for path in sorted((source / "editor/session").glob("engine_*.h"))]:
    text = text.partition("kSystemTexts")[0]  # those are the C library's
    for call in re.findall(r"trLater\(((?:\s*\"(?:[^\"\\\n]|\\.)*\")+)\)", text):
        english = literals(call)[0]
        tables += 1
        if dead := [piece for piece in pieces(english) if not made_of(piece, said)]:
            failures.append(f"the engine does not say {english!r}: {[' '.join(words) for words in dead]}")
if tables < 300:
    failures.append(f"only {tables} of the engine's texts were looked for")
if texts < 1000:
    failures.append(f"only {texts} texts were compared")
print(f"{texts} texts in {len(languages)} languages")
sys.exit("\n".join(failures) if failures else 0)
