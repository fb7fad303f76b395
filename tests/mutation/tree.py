"""A copy of the sources in which every drawn mutant is compiled, and one is chosen when a program starts.

The body of a function with mutants becomes `if (on(7)) { the body with mutant 7 } else if … else { the body }`.
"""

import subprocess
from collections import defaultdict
from pathlib import Path

HEADER = Path(__file__).with_name("mutation.h").read_text()
# No target of another processor, and no warnings where there are mutants: an unused variable is none.
CMAKE = """
foreach(folder IN ITEMS {folders})
  get_property(targets DIRECTORY ${{folder}} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${{target}} TYPE)
    if(type MATCHES "STATIC_LIBRARY|EXECUTABLE|OBJECT_LIBRARY")
      target_compile_options(${{target}} PRIVATE -w)
    endif()
  endforeach()
endforeach()
"""


def with_all(body, text, mutants, path):
    """The body from its first to its last brace, with all its mutants"""
    begin, end = body.tokens[0].start, body.tokens[-1].end
    out = "{"
    for number, mutant in mutants:
        changed = text[begin:mutant.start] + mutant.text + text[mutant.end:end]
        out += f" if (::stride_mutation::on({number}))\n#line 1 \"stride_mutant_{number}\"\n{changed}\nelse"
    return out + f"\n#line {text.count(chr(10), 0, begin) + 1} \"{path}\"\n{text[begin:end]}}}"


def mutated(text, mutants, path):
    """A file with its mutants: (number, mutant)"""
    of_body = defaultdict(list)
    for number, mutant in mutants:
        of_body[mutant.body.tokens[0].start].append((number, mutant))
    out, at = HEADER, 0
    if not path.endswith(".cpp"):
        out += "#pragma GCC system_header\n"
    out += f"#line 1 \"{path}\"\n"
    for start in sorted(of_body):
        body = of_body[start][0][1].body
        out += text[at:start] + with_all(body, text, of_body[start], path)
        at = body.tokens[-1].end
    return out + text[at:]


def write(path, text):
    """Not where nothing changes: what has been built stays"""
    if not path.exists() or path.read_bytes() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text)
        return True
    return False


def write_tree(top, tree, numbered):
    """Copies what git knows of `top`; `numbered` are all mutants by number"""
    of_file = defaultdict(list)
    for number, mutant in numbered.items():
        of_file[mutant.file].append((number, mutant))
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=top, check=True, capture_output=True, text=True).stdout
    names = {name for name in listed.split("\0") if name and (top / name).is_file()}
    for name in names:
        text = (top / name).read_bytes()
        if name in of_file:
            text = mutated(text.decode(), of_file[name], name).encode()
        elif name == "CMakeLists.txt":
            text += CMAKE.format(folders=" ".join(sorted({Path(file).parent.as_posix() for file in of_file}))).encode()
        target = tree / name
        if (top / name).is_symlink():
            continue
        if write(target, text):
            target.chmod((top / name).stat().st_mode)
    for target in tree.rglob("*"):
        name = target.relative_to(tree).as_posix()
        if target.is_file() and not name.startswith("build/") and name not in names:
            target.unlink()
