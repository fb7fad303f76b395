"""A program with retained variables that all say the same number, so that what is torn shows."""
import shutil

import invariants

PROGRAM = """TYPE Record : STRUCT a, b : LINT; text : STRING(30); END_STRUCT END_TYPE
FUNCTION_BLOCK Holder
VAR_OUTPUT n : LINT; END_VAR
n := GVL.n;
END_FUNCTION_BLOCK
PROGRAM Keeper
VAR RETAIN n, sum : LINT; holder : Holder; END_VAR
VAR PERSISTENT rows : ARRAY[0..{last}] OF LINT; record : Record; END_VAR
VAR i : DINT; began, agreed : BOOL; start : LINT; END_VAR
IF NOT began THEN
  began := TRUE;
  start := GVL.n;
  agreed := n = GVL.n AND holder.n = GVL.n AND sum = 7 * GVL.n AND record.a = GVL.n AND record.b = -GVL.n
            AND (GVL.n = 0 OR record.text = LINT_TO_STRING(GVL.n));
  FOR i := 0 TO {last} DO
    IF rows[i] <> GVL.n * (i + 1) THEN agreed := FALSE; END_IF
  END_FOR
END_IF
GVL.n := GVL.n + 1;
n := GVL.n;
sum := 7 * n;
record.a := n;
record.b := -n;
record.text := LINT_TO_STRING(n);
FOR i := 0 TO {last} DO
  rows[i] := n * (i + 1);
END_FOR
holder();
END_PROGRAM
"""
GLOBALS = "VAR_GLOBAL PERSISTENT n : LINT; END_VAR\n"


def write_project(folder, interval_ms, rows, more="", period_ms=100):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "Keeper.st").write_text(PROGRAM.format(last=rows - 1), encoding="utf-8")
    (folder / "GVL.st").write_text(GLOBALS, encoding="utf-8")
    (folder / "stride.toml").write_text(
        f'[project]\nname = "Kept"\n\n[[task]]\nname = "Task"\ninterval = "T#{interval_ms}ms"\nprograms = ["Keeper"]\n{more}\n'
        f'[retain]\nfile = "retain/Kept"\nperiod = "T#{period_ms}ms"\n', encoding="utf-8")
    return folder


def images(retain):
    """Those of the two files of a run that exist"""
    return [path for path in (retain.with_name(retain.name + end) for end in (".a", ".b")) if path.exists()]


def look(round_, app, retain, what):
    """What a start with copies of the files would find: the number in them, or nothing when there are no files. Each file must be
    complete by itself, and a start takes the newer one."""
    found = []
    chosen = images(retain)
    if not chosen:
        return None
    for number, some in enumerate([[path] for path in chosen] + [chosen]):
        folder = round_.folder / f"look-{round_.counts['looks']}-{number}"
        folder.mkdir()
        for path in some:
            shutil.copy(path, folder / path.name)
        ran = round_.host("sim", app, "--for", "1us", "--quiet", "--retain", folder / retain.name, "--print", "Keeper.start,Keeper.agreed", cwd=folder)
        values = invariants.printed(ran.out)
        round_.expect(ran.code == 0 and not ran.err, f"{what}: {[p.name for p in some]} ({[p.stat().st_size for p in some]} bytes): {ran.err}")
        round_.expect(values.get("Keeper.agreed") == "TRUE", f"{what}: {[p.name for p in some]} are torn: {values}")
        found.append(int(values.get("Keeper.start", 0)))
        shutil.rmtree(folder)
    round_.counts["looks"] += 1
    round_.expect(found[-1] == max(found[:-1]), f"{what}: a start takes {found[-1]} of {found[:-1]}")
    return found[-1]
