// app.cpp: the application object. build.cpp: what identifies this build, apart so that app.cpp
// stays the same when only a body changes.

#include "compiler/codegen/consistent_copies.hpp"
#include "compiler/codegen/description.hpp"
#include "compiler/codegen/layout_numbers.hpp"
#include "compiler/codegen/plc_tables.hpp"
#include "compiler/codegen/type_table.hpp"
#include "compiler/codegen/units.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/syntax/attributes.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>

#ifndef STRIDE_VERSION
#define STRIDE_VERSION "0.1.0"
#endif

namespace stc::codegen {

using namespace ast;

namespace {

/// A root with the name of its member in the state.
struct Member {
  Root root;
  std::string name;
};

class Application {
public:
  Application(Context &context, const AppConfig &config)
      : c_(context), config_(config), types_(context), copies_(context, config.tasks.size()),
        plc_(context, config, [this](std::string_view name) { return global(name); }) {
    collect();
  }

  GeneratedFile app() {
    const SymbolTexts symbols = symbolTexts();
    const std::string sizes = measures();
    std::string out = banner("The application object") + includes();
    state(out);
    out += sizes;
    places(out);
    out += copies_.places();
    if (c_.program.usesPool)
      out += "\nnamespace stride {\nconst ULINT poolPlace = offsetof(::st::user::App__, pool__);\n"
             "const ULINT poolSize = " +
             std::to_string(c_.program.settings.poolSize) + ";\n} // namespace stride\n";
    if (!symbols.declarations.empty())
      out += "\n// Numbers of lines of symbols.\n" + symbols.declarations;
    out += "\nnamespace {\n\nusing ::st::user::App__;\nusing ::stride::Kind;\n"
           "\n[[maybe_unused]] App__ &app__(::stride::Ctx *ctx__) { return *static_cast<App__ "
           "*>(ctx__->state); }\n";
    out += copies_.settle();
    init(out);
    tasks(out);
    out += symbols.tables;
    plc_.write();
    out += plc_.text();
    sharing(out);
    out += "\n} // namespace\n";
    const auto [length, place] = bootupError();
    out += description(
        {c_.program, config_, types_, plc_, hasExit_, hasReinit_, !copies_.empty(), length, place});
    return {"app.cpp", std::move(out)};
  }

  GeneratedFile build() {
    const Sources &sources = c_.program.sources;
    Hash all;
    all.add(STRIDE_VERSION).add(uint64_t{c_.program.settings.checks});
    std::string files;
    for (FileId id = 1; id <= sources.size(); ++id) {
      const SourceFile &file = sources.file(id);
      Hash own;
      own.add(file.text());
      all.add(file.codeName()).add(own.value());
      files +=
          "    {\"" + escaped(file.codeName()) + "\", " + std::to_string(own.value()) + "ULL},\n";
    }
    std::string out = banner("Identification of this build");
    out += "#include \"runtime/app/abi.h\"\n\nnamespace st::user {\nextern const "
           "::stride::StrideAppV1 application__;\n}\n"
           "\nnamespace {\n";
    if (sources.size() != 0)
      out += "\nconstexpr ::stride::SourceFileDesc kFiles[] = {\n" + files + "};\n";
    out += "\n::stride::StrideAppV1 description{};\n\n} // namespace\n"
           "\nextern \"C\" const ::stride::StrideAppV1 *stride_app_v1(void) {\n"
           "  description = ::st::user::application__;\n"
           "  description.buildHash = " +
           std::to_string(all.value()) + "ULL;\n";
    if (sources.size() != 0)
      out +=
          "  description.files = kFiles;\n  description.fileCount = ::stride::tableSize(kFiles);\n";
    out += "  return &description;\n}\n";
    return {"build.cpp", std::move(out)};
  }

  [[nodiscard]] const TypeTable &types() const { return types_; }

private:
  // Libraries first, by name; then the project's files by path, in the order of the text.
  void collect() {
    for (const File *file : c_.program.files) {
      for (const Decl *decl : file->declarations) {
        if (decl->kind != DeclKind::Globals)
          continue;
        const bool qualified = hasAttribute(decl->attributes, AttributeId::QualifiedOnly);
        const std::string_view renamed = renamedFrom(decl->attributes);
        for (const VarDecl *v : as<GlobalsDecl>(decl)->variables) {
          if (qualified)
            qualified_.insert(v);
          if (!renamed.empty())
            listRenamed_.emplace(v, renamed);
        }
      }
    }
    std::vector<const Library *> libraries;
    for (const auto &library : c_.program.libraries)
      libraries.push_back(library.get());
    std::sort(libraries.begin(), libraries.end(), [](const Library *a, const Library *b) {
      return std::pair(a->isUser, std::string_view(a->name)) <
             std::pair(b->isUser, std::string_view(b->name));
    });
    for (const Library *library : libraries) {
      std::vector<Root> roots;
      for (const GlobalsSymbol *g : library->globals)
        roots.push_back({g, false});
      for (const PouSymbol *p : library->pous) {
        if (p->decl->kind == DeclKind::Program && !p->isTemplate)
          roots.push_back({p, false});
        if (hasStatics(p))
          roots.push_back({p, true});
        for (const PouSymbol *m : p->methods) {
          if (hasStatics(m))
            roots.push_back({m, true});
        }
      }
      std::stable_sort(roots.begin(), roots.end(), [&](const Root &a, const Root &b) {
        const Span x = a.symbol->name.span;
        const Span y = b.symbol->name.span;
        if (x.file != y.file && x.file != 0 && y.file != 0)
          return c_.program.sources.file(x.file).name() < c_.program.sources.file(y.file).name();
        return x.begin < y.begin;
      });
      for (const Root &root : roots)
        members_.push_back({root, memberName(root)});
    }
  }

  std::string memberName(const Root &root) { return rootName(c_.names, root, c_.program.user); }

  void addRoots(const Member &m) {
    if (m.root.symbol->kind == SymbolKind::Pou && !m.root.isStatic) {
      const auto *program = static_cast<const PouSymbol *>(m.root.symbol);
      types_.addProgram(program, m.name, writerOf(program));
      return;
    }
    const bool own = m.root.symbol->library->isOwn;
    std::string list(m.root.symbol->name.text);
    if (m.root.isStatic && static_cast<const PouSymbol *>(m.root.symbol)->isMethod())
      list.insert(0, std::string(static_cast<const PouSymbol *>(m.root.symbol)->owner->name.text) +
                         "__");
    if (own) // several libraries may have a list, and a variable, of one name
      list.insert(0, m.root.symbol->library->name + ".");
    for (const VarSymbol *v : rootVariables(m.root))
      types_.addRoot(list, v, m.name + "." + fieldName(v),
                     own || m.root.isStatic || qualified_.contains(v->decl),
                     listRenamedFrom(m.root, v), writerOf(v));
  }

  /// The one task that writes the variable or calls the program.
  std::optional<uint32_t> writerOf(const Symbol *symbol) const {
    const auto &writers = c_.program.sharing.writers;
    const auto found = writers.find(symbol);
    return found == writers.end() ? std::nullopt : std::optional(found->second);
  }

  void sharing(std::string &out) {
    std::string uses;
    for (const ImageUse &use : c_.program.sharing.imageUses)
      uses += "    {" + std::to_string(use.task) + ", " + std::to_string(use.area) +
              (use.writes ? ", 1, " : ", 0, ") + std::to_string(use.first) + ", " +
              std::to_string(use.count) + "},\n";
    if (!uses.empty())
      out += "\n// {task, area, writes, first, count}\n"
             "constexpr ::stride::ImageUseDesc kImageUses[] = {\n" +
             uses + "};\n";
  }

  std::string_view listRenamedFrom(const Root &root, const VarSymbol *v) const {
    if (root.isStatic)
      return renamedFrom(static_cast<const PouSymbol *>(root.symbol)->decl->attributes);
    const auto found = listRenamed_.find(v->decl);
    return found == listRenamed_.end() ? std::string_view() : found->second;
  }

  /// Defines the constants by which bodies find the roots.
  void places(std::string &out) {
    const Library *open = nullptr;
    for (const Member &m : members_) {
      if (m.root.symbol->library != open) {
        if (open != nullptr)
          out += "}\n";
        open = m.root.symbol->library;
        out += "\nnamespace st::" + std::string(c_.names.space(open)) + " {\n";
      }
      out += "const ::stride::ULINT " + rootLocalPlace(c_.names, m.root) +
             " = offsetof(::st::user::App__, " + m.name + ");\n";
    }
    if (open != nullptr)
      out += "}\n";
    out += "\nnamespace st {\n";
    for (size_t area = 0; area < 3; ++area)
      out += std::string("const ::stride::ULINT image__") + "iqm"[area] + "__at__ = " +
             (c_.program.image.bytes[area] == 0
                  ? std::string("0")
                  : std::string("offsetof(::st::user::App__, image__") + "iqm"[area] + ")") +
             ";\n";
    out += "}\n";
  }

  /// Lists of constants, then other lists of global variables, then what may read both.
  static unsigned initRank(const Root &root) {
    if (root.symbol->kind != SymbolKind::Globals)
      return 2;
    const auto &variables = static_cast<const GlobalsSymbol *>(root.symbol)->variables;
    return std::all_of(variables.begin(), variables.end(),
                       [](const VarSymbol *v) { return v->isConstant; })
               ? 0
               : 1;
  }

  /// What needs it, in the order of docs/language.md: as members_ within one library and rank.
  std::vector<const Member *> initialized() const {
    std::vector<const Member *> result;
    for (auto begin = members_.begin(); begin != members_.end();) {
      const auto end = std::find_if(begin, members_.end(), [&](const Member &m) {
        return m.root.symbol->library != begin->root.symbol->library;
      });
      for (unsigned rank = 0; rank <= 2; ++rank)
        for (auto m = begin; m != end; ++m)
          if (initRank(m->root) == rank && rootNeedsInit(c_, m->root))
            result.push_back(&*m);
      begin = end;
    }
    return result;
  }

  void init(std::string &out) {
    out += "\n// Libraries first; constants, global variables, the rest; files by path; as "
           "declared.\nvoid "
           "init__(::stride::Ctx *";
    std::string body = copies_.begin();
    if (c_.program.settings.softMotion3)
      body += "  ctx__->softMotion3 = 1;\n";
    for (const SlotPlace &slot : c_.program.slotPlaces) {
      if (!slot.placed || slot.variable == nullptr)
        continue;
      const uint64_t number = slot.at.bit >= 0
                                  ? uint64_t{slot.at.byte} * 8 + static_cast<unsigned>(slot.at.bit)
                                  : slot.at.byte;
      if (number != 0)
        body += "  app__(ctx__)." + statePath(c_.names, slot.path, c_.program.user) + " = " +
                std::to_string(number) + "; // " +
                (slot.decl != nullptr ? std::string(slot.decl->address->text) : "a free place") +
                "\n";
    }
    for (const Member *m : initialized())
      body += "  app__(ctx__)." + m->name + ".init__(*ctx__);\n";
    if (hasConfiguredValues(c_.program))
      body += "  ::st::user::configure__(*ctx__);\n";
    if (!copies_.empty())
      body += "  settle__(ctx__);\n";
    out += (body.empty() ? ") {\n" : "ctx__) {\n") + body + "}\n";
    hasExit_ = lifecycle(out, "fb_exit", "exit__", true);
    hasReinit_ = lifecycle(out, "fb_reinit", "reinit__", false);
  }

  /// A walk over everything that has FB_Exit (last ones first) or FB_Reinit; false: nothing has.
  bool lifecycle(std::string &out, std::string_view method, std::string_view name, bool backwards) {
    std::string body;
    for (const Member &m : members_) {
      if (!rootHasLifecycle(c_, m.root, method))
        continue;
      const std::string line = "  app__(ctx__)." + m.name + "." + std::string(name) + "(*ctx__);\n";
      body = backwards ? line + body : body + line;
    }
    if (method == "fb_exit")
      body += exitsOfObjects();
    if (!body.empty())
      out += "\nvoid " + std::string(name) + "(::stride::Ctx *ctx__) {\n" + body + "}\n";
    return !body.empty();
  }

  /// FB_Exit of what __NEW has created and nobody has deleted; empty: nothing has one.
  std::string exitsOfObjects() {
    std::string cases;
    for (const Type *type : c_.program.created) {
      if (!c_.layouts.hasLifecycle(type, "fb_exit"))
        continue;
      types_.includes().complete(type);
      cases += "    case " + std::to_string(c_.layouts.hash(type)) +
               "ULL:\n      for (::stride::ULINT i = 0; i < block->count; ++i)\n"
               "        static_cast<" +
               std::string(c_.names.type(type)) + " *>(object)[i].exit__(*ctx__);\n      break;\n";
    }
    if (cases.empty())
      return cases;
    return "  ::stride::ULINT at = 0;\n  const ::stride::PoolBlock *block = nullptr;\n"
           "  while (void *const object = ::stride::poolNext(*ctx__, at, block)) {\n"
           "    switch (block->typeHash) {\n" +
           cases + "    default:\n      break;\n    }\n  }\n";
  }

  /// A function that calls programs in a cycle of a task.
  void calls(std::string &out, const std::string &what, const std::string &name, size_t task,
             const std::vector<PouSymbol *> &programs) {
    out += "\n/// " + what + "\nvoid " + name + "(::stride::Ctx *" +
           (programs.empty() ? "" : "ctx__") + ") {\n" + copies_.take(task);
    for (const PouSymbol *p : programs)
      out += "  app__(ctx__)." + memberName({p, false}) + ".body__(*ctx__);\n";
    out += copies_.give(task) + "}\n";
  }

  void tasks(std::string &out) {
    std::string rows;
    for (size_t i = 0; i < config_.tasks.size(); ++i) {
      const AppConfig::Task &task = config_.tasks[i];
      const std::string name = "task" + std::to_string(i) + "__";
      calls(out, task.name, name, i, task.programs);
      const std::string inStop = task.stopPrograms.empty() ? "" : "stop" + std::to_string(i) + "__";
      if (!inStop.empty())
        calls(out, task.name + " in STOP", inStop, i, task.stopPrograms);
      std::string event = "nullptr";
      if (task.event != nullptr) {
        event = "event" + std::to_string(i) + "__";
        out += "\n::stride::BOOL " + event + "(::stride::Ctx *ctx__) { return " +
               std::string(c_.names.qualified(task.event)) + "(*ctx__); }\n";
      }
      static constexpr std::string_view kKinds[] = {"Cyclic", "Freewheeling", "Event", "Status"};
      rows += "    {\"" + escaped(task.name) +
              "\", ::stride::TaskKind::" + std::string(kKinds[static_cast<size_t>(task.start)]) +
              ", " + std::to_string(task.priority) + ", " + std::to_string(task.intervalNs) + ", " +
              std::to_string(task.watchdogNs) + ", " + std::to_string(task.watchdogSensitivity) +
              ", " + (task.core ? std::to_string(*task.core) : "::stride::kNoIndex") + ", " + name +
              ", " + event;
      if (task.sync || !inStop.empty())
        rows += ", " + (task.sync ? std::to_string(*task.sync) : "::stride::kNoIndex");
      rows += (inStop.empty() ? "" : ", " + inStop) + "},\n";
    }
    if (!rows.empty())
      out += "\n// {name, kind, priority, intervalNs, watchdogNs, watchdogSensitivity, core, run, "
             "event, sync, runInStop}\n"
             "constexpr ::stride::TaskDesc kTasks[] = {\n" +
             rows + "};\n";
  }

  SymbolTexts symbolTexts() {
    for (const Member &m : members_)
      addRoots(m);
    types_.addImage();
    for (const AccessPath &access : c_.program.accessPaths)
      types_.addAccess(access);
    for (const Type *type : c_.program.created)
      types_.index(type); // the headers of their objects name them by hash
    if (c_.program.usesPool)
      types_.addPool(c_.program.settings.poolSize);
    return types_.texts();
  }

  /// What the compiler has computed with is what g++ sees.
  std::string measures() {
    std::string out;
    for (const auto &[type, size] : c_.program.measured) {
      types_.includes().complete(type);
      out += "static_assert(sizeof(" + std::string(c_.names.type(type)) +
             ") == " + std::to_string(size) + ");\n";
    }
    return out.empty() ? out : "\n// What SIZEOF has given.\n" + out;
  }

  std::string includes() {
    for (const Member &m : members_)
      types_.includes().symbol(m.root.symbol);
    for (const AppConfig::Task &task : config_.tasks)
      if (task.event != nullptr)
        types_.includes().symbol(task.event);
    std::string out = "#include \"runtime/app/abi.h\"\n#include \"runtime/iec/image.h\"\n";
    if (c_.program.usesPool)
      out += "#include \"runtime/iec/pool.h\"\n";
    if (!copies_.empty())
      out += "#include \"runtime/iec/consistent.h\"\n";
    return out + types_.includes().text(nullptr) +
           "\n#pragma GCC diagnostic ignored \"-Winvalid-offsetof\"\n";
  }

  void state(std::string &out) {
    out += "\nnamespace st::user {\n\n/// All state of the application.\nstruct App__ {\n";
    for (const Member &m : members_)
      out += "  " + rootType(c_.names, m.root) + " " + m.name + ";\n";
    out += copies_.members();
    for (size_t area = 0; area < 3; ++area) {
      if (const uint32_t bytes = c_.program.image.bytes[area]; bytes != 0)
        out += std::string("  alignas(8) ::stride::BYTE image__") + "iqm"[area] + "[" +
               std::to_string(bytes) + "]; // %" + "IQM"[area] + "\n";
    }
    if (c_.program.usesPool)
      out += "  ::stride::Pool<" + std::to_string(c_.program.settings.poolSize) +
             "> pool__; // of __NEW\n";
    else if (members_.empty())
      out += "  ::stride::BYTE empty__;\n";
    out += "};\n";
    if (hasConfiguredValues(c_.program))
      out += "\nvoid configure__(::stride::Ctx &ctx__);\n";
    out += "\n} // namespace st::user\n";
  }

  /// A global variable by name, and its place in the state.
  PlacedVariable global(std::string_view name) const {
    const std::string wanted = lowerCase(name);
    for (const Member &m : members_) {
      if (m.root.symbol->kind != SymbolKind::Globals || !m.root.symbol->library->isUser)
        continue;
      for (const VarSymbol *v : static_cast<const GlobalsSymbol *>(m.root.symbol)->variables) {
        if (v->name.id->lower == wanted)
          return {v, m.name + "." + mangle(v->name.text)};
      }
    }
    return {};
  }

  /// g_strBootupError for the description: length and place.
  [[nodiscard]] std::pair<std::string, std::string> bootupError() const {
    for (const Member &m : members_) {
      if (m.root.symbol->kind != SymbolKind::Globals ||
          m.root.symbol->library->name != "SM_DriveBasic")
        continue;
      for (const VarSymbol *v : static_cast<const GlobalsSymbol *>(m.root.symbol)->variables)
        if (v->name.id->lower == "g_strbootuperror")
          return {std::to_string(static_cast<const StringType *>(v->type)->length),
                  "offsetof(App__, " + m.name + "." + std::string(mangle(v->name.text)) + ")"};
    }
    return {"0", "0"};
  }

  Context &c_;
  const AppConfig &config_;
  TypeTable types_;
  ConsistentCopies copies_;
  PlcTables plc_;
  std::vector<Member> members_;
  std::unordered_set<const VarDecl *> qualified_; ///< in lists with {attribute 'qualified_only'}
  /// In lists with {attribute 'renamed_from'}: the list's earlier name.
  std::unordered_map<const VarDecl *, std::string_view> listRenamed_;
  bool hasExit_ = false;
  bool hasReinit_ = false;
};

} // namespace

} // namespace stc::codegen

namespace stc {

std::vector<GeneratedFile> generateLibrary(const Program &program, const Library &library) {
  codegen::Context context(program, &library);
  std::vector<GeneratedFile> files;
  codegen::generateUnits(context, {codegen::generateDispatch}, files);
  return files;
}

std::vector<GeneratedFile> generateApplication(const Program &program, const AppConfig &config) {
  std::vector<GeneratedFile> files;
  for (const auto &library : program.libraries) {
    if (!library->isBuilt)
      continue;
    codegen::Context own(program, library.get());
    codegen::generateUnits(own, {}, files);
  }
  codegen::Context context(program, program.user);
  std::vector<const PouSymbol *> withNumbers;
  const auto app = [&](codegen::Context &own, std::vector<GeneratedFile> &to) {
    codegen::Application application(own, config);
    to.push_back(application.app());
    withNumbers = application.types().withOwnNumbers();
  };
  const auto build = [&config](codegen::Context &own, std::vector<GeneratedFile> &to) {
    to.push_back(codegen::Application(own, config).build());
  };
  codegen::generateUnits(context, {codegen::generateDispatch, app, build}, files);
  codegen::addOwnNumbers(context, withNumbers, files);
  return files;
}

} // namespace stc
