// dispatch__.cpp: what finds the method of the block that an instance really is. A library brings
// weak functions that know its own blocks; those of an application know all blocks and replace
// them.

#include "compiler/codegen/calls/signatures.hpp"
#include "compiler/codegen/units.hpp"
#include "compiler/semantics/hierarchy.hpp"

#include <map>

namespace stc::codegen {

using namespace ast;

namespace {

class DispatchBuilder {
public:
  explicit DispatchBuilder(Context &context) : c_(context), includes_(context.names) {
    for (const auto &library : c_.program.libraries) {
      for (const PouSymbol *p : library->pous) {
        if (p->isBlock() && hasTypeId(p))
          blocks_.push_back(p);
      }
    }
  }

  bool run() {
    for (const auto &library : c_.program.libraries) {
      if (library.get() != c_.own && !c_.own->isUser)
        continue;
      const size_t start = text_.size();
      for (const PouSymbol *p : library->pous) {
        if (p->isInterface())
          interface(p);
        else if (p->isBlock() && hasTypeId(p))
          block(p);
      }
      if (text_.size() == start)
        continue;
      text_.insert(start, "\nnamespace st::" + std::string(c_.names.space(library.get())) + " {\n");
      text_ += "\n} // namespace st::" + std::string(c_.names.space(library.get())) + "\n";
    }
    return !text_.empty();
  }

  GeneratedFile finish() {
    const std::string path = std::string(c_.names.space(c_.own)) + "/dispatch__.cpp";
    return {path, banner("Which method is meant") + includes_.text(nullptr) +
                      std::string(sourcePrelude()) +
                      "#pragma GCC diagnostic ignored \"-Wunused-parameter\"\n" + text_};
  }

private:
  std::string_view weak() const { return c_.own->isUser ? "" : "__attribute__((weak)) "; }

  std::string id(const PouSymbol *p) { return std::to_string(c_.names.typeId(p)) + "U"; }

  /// `bool X__is__(…)`: for whom `test` holds.
  template <class Test> void predicate(const PouSymbol *symbol, Test &&test) {
    includes_.symbol(symbol);
    std::string cases;
    for (const PouSymbol *p : blocks_) {
      if (test(p))
        cases += "  case " + id(p) + ": // " + std::string(p->name.text) + "\n";
    }
    text_ += "\n" + std::string(weak()) + "bool " + std::string(c_.names.local(symbol)) +
             "__is__(::stride::UDINT type__) {\n";
    if (cases.empty()) {
      text_ += "  static_cast<void>(type__);\n  return false;\n}\n";
      return;
    }
    text_ += "  switch (type__) {\n" + cases +
             "    return true;\n  default:\n    return false;\n  }\n}\n";
  }

  void interface(const PouSymbol *symbol) {
    predicate(symbol, [&](const PouSymbol *p) { return implements(p, symbol); });
    for (const PouSymbol *m : symbol->methods) {
      std::map<const PouSymbol *, std::vector<const PouSymbol *>> targets;
      for (const PouSymbol *p : blocks_) {
        if (p->isAbstract() || !implements(p, symbol))
          continue;
        if (const PouSymbol *target = implementation(p, m);
            target != nullptr && !target->isAbstract())
          targets[target].push_back(p);
      }
      complete(m);
      text_ += "\n" + std::string(weak()) +
               methodSignature(c_, includes_, m, c_.names.local(m), true, nullptr) + " {\n";
      text_ += "  switch (*self__) {\n";
      for (const PouSymbol *p : blocks_) { // in the order of the declarations
        for (const auto &[target, list] : targets) {
          if (list.front() != p)
            continue;
          for (const PouSymbol *b : list)
            text_ += "  case " + id(b) + ": // " + std::string(b->name.text) + "\n";
          const std::string type(c_.names.qualified(p));
          includes_.symbol(p);
          text_ += "    return reinterpret_cast<" + type +
                   " *>(reinterpret_cast<char *>(self__) - " + "offsetof(" + type + ", " +
                   pathToTypeId(p) + "))->" + pathToBase(p, target->owner) + call(target, m) +
                   ";\n";
        }
      }
      fail(m);
      text_ += "  }\n}\n";
    }
  }

  void block(const PouSymbol *symbol) {
    predicate(symbol, [&](const PouSymbol *p) { return derivesFrom(p, symbol); });
    for (const PouSymbol *m : symbol->methods) {
      if (!isDispatched(m))
        continue;
      complete(m);
      text_ +=
          "\n" + std::string(weak()) +
          methodSignature(c_, includes_, m,
                          std::string(c_.names.local(symbol)) + "::" + methodName(m) + "__call",
                          false, nullptr) +
          " {\n  switch (this->" + pathToTypeId(symbol) + ") {\n";
      for (const PouSymbol *p : blocks_) {
        if (p == symbol || !derivesFrom(p, symbol) || p->isAbstract())
          continue;
        const PouSymbol *target = implementation(p, m);
        if (target == m || target->isAbstract())
          continue;
        const std::string type(c_.names.qualified(target->owner));
        includes_.symbol(target->owner);
        text_ += "  case " + id(p) + ": // " + std::string(p->name.text) +
                 "\n    return reinterpret_cast<" + type + " *>(this)->" + call(target, m) + ";\n";
      }
      if (m->isAbstract())
        fail(m);
      else
        text_ += "  default:\n    return this->" + call(m, m) + ";\n";
      text_ += "  }\n}\n";
    }
    if (!isBodyDispatched(symbol))
      return;
    text_ += "\n" + std::string(weak()) + "void " + std::string(c_.names.local(symbol)) +
             "::body__call(::stride::Ctx &ctx__) {\n  switch (this->" + pathToTypeId(symbol) +
             ") {\n";
    for (const PouSymbol *p : blocks_) {
      if (p == symbol || !derivesFrom(p, symbol) || p->decl->kind != DeclKind::FunctionBlock)
        continue;
      const std::string type(c_.names.qualified(p));
      includes_.symbol(p);
      text_ += "  case " + id(p) + ":\n    return reinterpret_cast<" + type +
               " *>(this)->body__(ctx__);\n";
    }
    text_ += "  default:\n    return this->body__(ctx__);\n  }\n}\n";
  }

  /// What a definition of the method passes by value; also one that finds no block to call.
  void complete(const PouSymbol *method) {
    for (const VarSymbol *p : method->parameters())
      includes_.complete(p->type);
    if (method->result != nullptr)
      includes_.complete(method->result->type);
  }

  /// `Run(ctx__, speed)` with the parameters' names of `declared`.
  std::string call(const PouSymbol *target, const PouSymbol *declared) {
    complete(target);
    std::string text = methodName(target) + "(ctx__";
    for (const VarSymbol *p : declared->parameters())
      text += ", " + mangle(p->name.text);
    return text + ")";
  }

  void fail(const PouSymbol *m) {
    const Sources &sources = c_.program.sources;
    const LineColumn at = sources.position(m->name.span);
    text_ += "  default:\n    ::stride::raise(ctx__, ::stride::ExceptionCode::AbstractCall, \"" +
             escaped(sources.file(m->name.span.file).codeName()) + "\", " +
             std::to_string(at.line) + ", " + std::to_string(at.column) + ");\n";
  }

  Context &c_;
  Includes includes_;
  std::vector<const PouSymbol *> blocks_;
  std::string text_;
};

} // namespace

void generateDispatch(Context &context, std::vector<GeneratedFile> &files) {
  DispatchBuilder builder(context);
  if (builder.run())
    files.push_back(builder.finish());
}

} // namespace stc::codegen
