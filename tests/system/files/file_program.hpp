// A program that works with files all the time.
#ifndef STRIDE_TESTS_SYSTEM_FILES_FILE_PROGRAM_HPP
#define STRIDE_TESTS_SYSTEM_FILES_FILE_PROGRAM_HPP

namespace stride::test {

/// Writes and reads back, by the blocks and by the functions, with files of changing names;
/// `rounds` counts what was right, `wrong` what was not.
inline constexpr const char *kFileProgram = R"(PROGRAM PLC_PRG
VAR
  step : INT;
  round, rounds, wrong, waits : DINT;
  name, text, back : STRING;
  first : STRING := 'R';
  h : DWORD;
  n : DWORD;
  open : SysFileOpenAsync;
  write : SysFileWriteAsync;
  move : SysFileSetPosAsync;
  read : SysFileReadAsync;
  close : SysFileCloseAsync;
  clock : CurTime;
  now : SysTime64;
END_VAR
clock(SystemTime := now);
CASE step OF
  0:
    name := CONCAT('f', DINT_TO_STRING(round MOD 3));
    text := CONCAT('round ', DINT_TO_STRING(round));
    back := '';
    step := 1;
  1:
    h := SysFileOpen(name, 'w');
    IF h <> 0 THEN
      n := SysFileWrite(h, ADR(text), INT_TO_DWORD(LEN(text)));
      step := 2;
    END_IF
  2:
    IF SysFileClose(h) THEN step := 3; END_IF
  3:
    open(bEnable := TRUE, stFileName := name, stMode := 'r+');
    IF open.bDone THEN open(bEnable := FALSE); step := 4; END_IF
  4:
    write(bEnable := TRUE, hFile := open.hFile, pBuffer := ADR(first), dwSize := 1);
    IF write.bDone THEN write(bEnable := FALSE); step := 5; END_IF
  5:
    move(bEnable := TRUE, hFile := open.hFile, dwPos := 0);
    IF move.bDone THEN move(bEnable := FALSE); step := 6; END_IF
  6:
    read(bEnable := TRUE, hFile := open.hFile, pBuffer := ADR(back), dwSize := 80);
    IF read.bDone THEN read(bEnable := FALSE); step := 7; END_IF
  7:
    close(bEnable := TRUE, hFile := open.hFile);
    IF close.bDone THEN close(bEnable := FALSE); step := 8; END_IF
  8:
    IF back = CONCAT('Round ', DINT_TO_STRING(round)) THEN rounds := rounds + 1; ELSE wrong := wrong + 1; END_IF
    round := round + 1;
    step := 0;
END_CASE
IF SysFileGetError() = SYSFILE_ERROR.PENDING THEN waits := waits + 1; END_IF
END_PROGRAM
)";

/// Runs it every millisecond.
inline constexpr const char *kFileProject =
    "[[task]]\nname = \"Fast\"\ninterval = \"T#1ms\"\nprograms = [\"PLC_PRG\"]\n";

} // namespace stride::test

#endif // STRIDE_TESTS_SYSTEM_FILES_FILE_PROGRAM_HPP
