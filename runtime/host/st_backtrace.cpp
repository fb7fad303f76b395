#include "runtime/host/st_backtrace.hpp"

#include <cxxabi.h>
#include <dwarf.h>
#include <elfutils/libdw.h>
#include <elfutils/libdwfl.h>
#include <fmt/format.h>

#include <cstdlib>
#include <memory>
#include <string_view>

namespace stride::host {

namespace {

/// Messages stay readable when a recursion has filled the stack.
constexpr size_t kShownCalls = 12;

bool endsWith(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/// Everything compiled from ST says so by #line; generated and native code does not.
bool isSt(const char *file) {
  const std::string_view name = file != nullptr ? file : "";
  return !name.empty() && !endsWith(name, ".cpp") && !endsWith(name, ".h") &&
         !endsWith(name, ".hpp") && !endsWith(name, ".c") && !endsWith(name, ".S");
}

std::string demangle(const char *name) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> text(
      abi::__cxa_demangle(name, nullptr, nullptr, &status), &std::free);
  return text ? text.get() : name;
}

std::string nameOf(Dwarf_Die &function) {
  Dwarf_Attribute attribute;
  for (const unsigned kind : {DW_AT_linkage_name, DW_AT_name})
    if (const char *name = dwarf_formstring(dwarf_attr_integrate(&function, kind, &attribute)))
      return pouName(demangle(name));
  return {};
}

/// The modules of this process with their debug information.
class Modules {
public:
  Modules() : session_(::dwfl_begin(&kCallbacks)) {
    if (session_ == nullptr)
      return;
    ::dwfl_report_begin(session_);
    if (::dwfl_linux_proc_report(session_, ::getpid()) != 0 ||
        ::dwfl_report_end(session_, nullptr, nullptr) != 0)
      close();
  }
  ~Modules() { close(); }
  Modules(const Modules &) = delete;
  Modules &operator=(const Modules &) = delete;

  /// The ST calls at an address: the innermost inlined one first. `split` is whether the call
  /// before was from a part that g++ has split off its function, and becomes that of this one.
  void append(uintptr_t address, std::vector<StCall> &calls, bool &split) const {
    Dwfl_Module *module = session_ != nullptr ? ::dwfl_addrmodule(session_, address) : nullptr;
    Dwarf_Addr bias = 0;
    Dwarf_Die *unit = module != nullptr ? ::dwfl_module_addrdie(module, address, &bias) : nullptr;
    if (unit == nullptr)
      return;
    Dwarf_Line *line = ::dwarf_getsrc_die(unit, address - bias);
    bool isRest = split;
    const size_t before = calls.size();
    const char *symbol = ::dwfl_module_addrname(module, address);
    split = symbol != nullptr && std::string_view(symbol).find(".part.") != std::string_view::npos;
    int number = 0;
    const char *file = line != nullptr ? ::dwarf_linesrc(line, nullptr, nullptr) : nullptr;
    if (line != nullptr)
      ::dwarf_lineno(line, &number);
    for (Dwarf_Die &scope : scopesAt(*unit, address - bias)) {
      const int tag = ::dwarf_tag(&scope);
      if (tag != DW_TAG_inlined_subroutine && tag != DW_TAG_subprogram)
        continue;
      add(scope, file, number, calls, isRest);
      if (calls.size() > before + 1 && calls.back() == calls[calls.size() - 2])
        calls.pop_back();
      if (tag == DW_TAG_subprogram)
        return;
      callSite(*unit, scope, file, number);
    }
  }

private:
  /// The innermost scope at an address of the unit, and those around it in the machine code.
  static std::vector<Dwarf_Die> scopesAt(Dwarf_Die &unit, Dwarf_Addr address) {
    Dwarf_Die *list = nullptr;
    // After an inlined function this gives what is around its definition ...
    const bool found = ::dwarf_getscopes(&unit, address, &list) > 0;
    const std::unique_ptr<Dwarf_Die, decltype(&std::free)> lexical(list, &std::free);
    if (!found)
      return {};
    // ... and this what is around its call.
    Dwarf_Die *physical = nullptr;
    const int count = ::dwarf_getscopes_die(&list[0], &physical);
    const std::unique_ptr<Dwarf_Die, decltype(&std::free)> owner(physical, &std::free);
    return count > 0 ? std::vector<Dwarf_Die>(physical, physical + count)
                     : std::vector<Dwarf_Die>();
  }

  /// `isRest`: the first one is the function whose part the last call is.
  static void add(Dwarf_Die &scope, const char *file, int line, std::vector<StCall> &calls,
                  bool &isRest) {
    if (!isSt(file))
      return;
    std::string pou = nameOf(scope);
    if (!pou.empty() && !(isRest && !calls.empty() && calls.back().pou == pou))
      calls.push_back({std::move(pou), file, line});
    isRest = false;
  }

  /// Where an inlined function was called from.
  static void callSite(Dwarf_Die &unit, Dwarf_Die &scope, const char *&file, int &line) {
    Dwarf_Attribute attribute;
    Dwarf_Word number = 0;
    file = nullptr;
    line = 0;
    if (::dwarf_formudata(::dwarf_attr(&scope, DW_AT_call_line, &attribute), &number) == 0)
      line = static_cast<int>(number);
    Dwarf_Files *files = nullptr;
    size_t count = 0;
    if (::dwarf_formudata(::dwarf_attr(&scope, DW_AT_call_file, &attribute), &number) == 0 &&
        ::dwarf_getsrcfiles(&unit, &files, &count) == 0)
      file = ::dwarf_filesrc(files, number, nullptr, nullptr);
  }

  void close() {
    if (session_ != nullptr)
      ::dwfl_end(session_);
    session_ = nullptr;
  }

  static constexpr Dwfl_Callbacks kCallbacks = {::dwfl_linux_proc_find_elf,
                                                ::dwfl_standard_find_debuginfo, nullptr, nullptr};
  Dwfl *session_;
};

/// As it was given to the compiler: libdw puts the folder before the names in the line table,
/// which is `.` in all applications.
std::string shortFile(const std::string &file) {
  return file.compare(0, 2, "./") == 0 ? file.substr(2) : file;
}

} // namespace

std::string pouName(const std::string &demangled) {
  std::string name = demangled.substr(0, demangled.find('('));
  if (name.compare(0, 4, "st::") != 0)
    return {};
  name.erase(0, name.find("::", 4) + 2); // the library
  if (endsWith(name, "::body__"))
    name.erase(name.size() - 8);
  std::string accessor;
  if (endsWith(name, "__get"))
    accessor = " (GET)";
  else if (endsWith(name, "__set"))
    accessor = " (SET)";
  if (!accessor.empty())
    name.erase(name.size() - 5);
  if (endsWith(name, "__"))
    return {}; // generated around the ST: init__, exit__
  for (size_t at = name.find("::"); at != std::string::npos; at = name.find("::"))
    name.replace(at, 2, ".");
  return name + accessor;
}

std::vector<StCall> resolveCalls(std::span<const uintptr_t> calls) {
  std::vector<StCall> result;
  if (calls.empty())
    return result;
  const Modules modules;
  bool split = false;
  for (const uintptr_t address : calls) {
    if (address == 0)
      result.push_back({});
    else
      modules.append(address, result, split);
  }
  for (StCall &call : result)
    call.file = shortFile(call.file);
  return result;
}

/// Left out there is what is on both sides: a recursion.
static bool isGapWithin(const std::vector<StCall> &calls, size_t at) {
  return calls[at].pou.empty() && at != 0 && at + 1 < calls.size() &&
         calls[at - 1] == calls[at + 1];
}

std::string describeWithCalls(const task::Fault &fault) {
  const std::vector<StCall> calls = resolveCalls(fault.exception.calls());
  const auto place = [](const StCall &call) { return fmt::format("{}:{}", call.file, call.line); };
  std::string text = task::describe(fault, calls.empty() ? std::string() : place(calls.front()));
  if (calls.size() < 2)
    return text;
  size_t shown = 0;
  for (size_t i = 0; i < calls.size();) {
    if (shown++ == kShownCalls || calls[i].pou.empty()) {
      text += "\n  …";
      if (shown > kShownCalls)
        break;
      ++i;
      continue;
    }
    size_t times = 1;
    while (i + times < calls.size() &&
           (calls[i + times] == calls[i] || isGapWithin(calls, i + times)))
      ++times;
    text += fmt::format("\n  {} {} at {}{}", i == 0 ? "in" : "called by", calls[i].pou,
                        place(calls[i]), times > 1 ? " (many times)" : "");
    i += times;
  }
  return text;
}

} // namespace stride::host
