// Headers: one per type, POU and variable list.

#include "compiler/codegen/calls/signatures.hpp"
#include "compiler/codegen/initial/initializers.hpp"
#include "compiler/codegen/units.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/syntax/st_text.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

std::string hex(uint64_t value) {
  std::string out = "0x0000000000000000ULL";
  for (size_t i = 17; i > 1; --i, value >>= 4U)
    out[i] = "0123456789abcdef"[value & 15U];
  return out;
}

class HeaderBuilder {
public:
  explicit HeaderBuilder(Context &context) : c_(context), includes_(context.names) {}

  GeneratedFile structure(const TypeSymbol *symbol) {
    const auto *type = typeAs<StructType>(symbol->type);
    open(symbol);
    packed(type->pack);
    body_ += (type->isUnion ? "union " : "struct ") + name_ + " {\n";
    if (type->base != nullptr) {
      includes_.complete(type->base);
      body_ += "  " + std::string(c_.names.type(type->base)) + " base__; // EXTENDS\n";
    }
    for (const VarSymbol *v : type->fields)
      field(v);
    if (symbol->onDemand)
      initHere(type);
    else
      init(c_.layouts.needsInit(type));
    lifecycle(type);
    assignment(type);
    body_ += "};\n";
    unpacked(type->pack);
    layout(type);
    return close(symbol);
  }

  GeneratedFile enumeration(const TypeSymbol *symbol) {
    const auto *type = typeAs<EnumType>(symbol->type);
    open(symbol);
    body_ += "using " + name_ + " = " + std::string(c_.names.type(type->base)) + ";\n";
    const Type *base = underlying(type);
    for (const EnumeratorSymbol *e : type->enumerators) {
      body_ += "inline constexpr " + name_ + " " + name_ + "__" + std::string(e->name.text) + " = ";
      const bool unsigned64 = isUnsigned64(base);
      body_ += unsigned64 ? std::to_string(static_cast<uint64_t>(e->value)) + "ULL"
                          : std::to_string(e->value);
      body_ += ";\n";
    }
    if (type->named) {
      body_ += "/// The enumerator's name for TO_STRING; null when there is none.\nconstexpr const "
               "char *" +
               name_ + "__name__(" + name_ + " value) {\n";
      for (const EnumeratorSymbol *e : type->enumerators)
        body_ += "  if (value == " + name_ + "__" + std::string(e->name.text) + ")\n    return \"" +
                 std::string(e->name.text) + "\";\n";
      body_ += "  return nullptr;\n}\n";
    }
    return close(symbol);
  }

  GeneratedFile alias(const TypeSymbol *symbol) {
    open(symbol);
    includes_.complete(symbol->type);
    body_ += "using " + name_ + " = " + std::string(c_.names.type(symbol->type)) + ";\n";
    return close(symbol);
  }

  GeneratedFile globals(const GlobalsSymbol *symbol) {
    open(symbol);
    body_ += "struct " + name_ + " {\n";
    for (const VarSymbol *v : symbol->variables) {
      if (!isPlaced(v))
        field(v);
    }
    init(rootNeedsInit(c_, {symbol, false}));
    rootLifecycle({symbol, false});
    body_ += "};\n";
    place({symbol, false});
    for (const ConsistentVariable &v : c_.program.sharing.consistent) {
      if (v.variable->globals != symbol)
        continue;
      body_ += "extern const ::stride::ULINT " + copiesLocalPlace(c_.names, v.variable) +
               "; // what each task reads\n";
    }
    return close(symbol);
  }

  GeneratedFile block(const PouSymbol *symbol) {
    open(symbol);
    packed(symbol->type->pack);
    body_ += "struct " + name_ + " {\n";
    Section section = Section::Access;
    if (symbol->base != nullptr) {
      includes_.complete(symbol->base->type);
      body_ += "  " + std::string(c_.names.type(symbol->base->type)) + " base__; // EXTENDS\n";
    }
    if (carriesTypeId(symbol))
      body_ += "  ::stride::UDINT type__; // which block this really is\n";
    for (const VarSymbol *v : symbol->variables) {
      if (!isField(v))
        continue;
      if (v->section != section)
        body_.append("  // ").append(sectionName(v->section)).append("\n");
      section = v->section;
      field(v);
    }
    init(c_.layouts.needsInit(symbol->type));
    if (symbol->type->kind == TypeKind::FunctionBlock) // there is only one of a program
      assignment(symbol->type);
    lifecycle(symbol->type);
    if (symbol->decl->kind != DeclKind::Class)
      body_ += "  void body__(::stride::Ctx &ctx__);\n";
    if (isBodyDispatched(symbol))
      body_ += "  void body__call(::stride::Ctx &ctx__); // of the block this really is\n";
    for (const PouSymbol *m : symbol->methods)
      method(m);
    body_ += "};\n";
    unpacked(symbol->type->pack);
    layout(symbol->type);
    if (symbol->decl->kind == DeclKind::Program)
      place({symbol, false});
    statics(symbol);
    for (const PouSymbol *m : symbol->methods)
      statics(m);
    if (hasTypeId(symbol))
      body_ += "/// Whether a type id belongs to this block or to one that extends it.\nbool " +
               name_ + "__is__(::stride::UDINT type__);\n";
    return close(symbol);
  }

  /// Methods of an interface are functions that look at the instance's type.
  GeneratedFile interface(const PouSymbol *symbol) {
    open(symbol);
    body_ += "/// Whether a type id belongs to a block that implements the interface.\nbool " +
             name_ + "__is__(::stride::UDINT type__);\n";
    for (const PouSymbol *m : symbol->methods)
      body_ += methodSignature(c_, includes_, m, c_.names.local(m), true, nullptr) + ";\n";
    return close(symbol);
  }

  GeneratedFile function(const PouSymbol *symbol) {
    open(symbol);
    statics(symbol);
    body_ += functionSignature(c_, includes_, symbol, nullptr);
    body_ += ";\n";
    return close(symbol);
  }

private:
  void open(const Symbol *symbol) { name_ = c_.names.local(symbol); }

  void packed(unsigned pack) {
    if (pack != 0)
      body_ += "#pragma pack(push, " + std::to_string(pack) + ")\n";
  }
  void unpacked(unsigned pack) {
    if (pack != 0)
      body_ += "#pragma pack(pop)\n";
  }

  void field(const VarSymbol *v) {
    if (isSlot(v)) {
      body_ += "  " + declared("::stride::UDINT", mangle(v->name.text)) +
               "; // its place (VAR_CONFIG)\n";
      return;
    }
    std::string type(c_.names.type(v->type));
    if (v->section == Section::InOut && v->type->kind != TypeKind::OpenArray) {
      includes_.pointed(v->type);
      type = declared(type, "*");
    } else {
      includes_.complete(v->type);
    }
    body_ += "  " + declared(type, fieldName(v)) + (v->isBit ? " : 1;\n" : ";\n");
  }

  void init(bool needed) {
    body_ +=
        needed ? "  void init__(::stride::Ctx &ctx__);\n" : "  void init__(::stride::Ctx &) {}\n";
  }

  /// The whole function: no source of the library has it.
  void initHere(const StructType *type) {
    EmitContext cx(c_, nullptr);
    cx.out.withoutDirectives();
    cx.open();
    cx.open();
    for (const VarSymbol *v : type->fields)
      if (c_.layouts.needsInit(v))
        initVariable(cx, "this->" + fieldName(v), v);
    body_ += "  void init__(::stride::Ctx &) {\n" + cx.out.take() + "  }\n";
  }

  /// Assignment that leaves the bindings of in-outs as they are.
  void assignment(const Type *type) {
    if (c_.layouts.hasBindings(type))
      body_ += "  void assign__(::stride::Ctx &ctx__, const " + name_ + " &from);\n";
  }

  void lifecycle(const Type *type) {
    if (c_.layouts.hasLifecycle(type, "fb_exit"))
      body_ += "  void exit__(::stride::Ctx &ctx__);\n";
    if (c_.layouts.hasLifecycle(type, "fb_reinit"))
      body_ += "  void reinit__(::stride::Ctx &ctx__);\n";
  }

  void rootLifecycle(const Root &root) {
    if (rootHasLifecycle(c_, root, "fb_exit"))
      body_ += "  void exit__(::stride::Ctx &ctx__);\n";
    if (rootHasLifecycle(c_, root, "fb_reinit"))
      body_ += "  void reinit__(::stride::Ctx &ctx__);\n";
  }

  void method(const PouSymbol *m) {
    if (!m->isAbstract())
      body_ += "  " + methodSignature(c_, includes_, m, methodName(m), false, nullptr) + ";\n";
    if (isDispatched(m))
      body_ += "  " + methodSignature(c_, includes_, m, methodName(m) + "__call", false, nullptr) +
               "; // of the block this really is\n";
  }

  void layout(const Type *type) {
    body_ += "/// Changes when the layout does.\ninline constexpr ::stride::ULINT " + name_ +
             "__layout__ = " + hex(c_.layouts.hash(type)) + ";\n";
  }

  void place(const Root &root) {
    body_ += "/// Its place in the application's state, which the application defines.\nextern "
             "const ::stride::ULINT " +
             rootLocalPlace(c_.names, root) + ";\n";
  }

  void statics(const PouSymbol *symbol) {
    if (!hasStatics(symbol))
      return;
    body_ += "\nstruct " + std::string(c_.names.local(symbol)) + "__static__ {\n";
    for (const VarSymbol *v : symbol->variables) {
      if (v->section == Section::Stat && !isPlaced(v))
        field(v);
    }
    init(rootNeedsInit(c_, {symbol, true}));
    rootLifecycle({symbol, true});
    body_ += "};\n";
    place({symbol, true});
    body_ += "\n";
  }

  GeneratedFile close(const Symbol *symbol) {
    GeneratedFile file;
    file.path = c_.names.header(symbol);
    file.text = banner(symbol->name.text) + "#pragma once\n#include \"runtime/iec/types.h\"\n" +
                includes_.text(symbol);
    file.text += "\nnamespace stride {\nstruct Ctx;\n}\n\nnamespace st::";
    file.text += std::string(c_.names.space(symbol->library)) + " {\n\n" + body_ + "\n}\n";
    return file;
  }

  Context &c_;
  Includes includes_;
  std::string name_;
  std::string body_;
};

} // namespace

std::vector<const VarSymbol *> rootVariables(const Root &root) {
  std::vector<const VarSymbol *> list;
  if (root.symbol->kind == SymbolKind::Globals) {
    for (const VarSymbol *v : static_cast<const GlobalsSymbol *>(root.symbol)->variables)
      list.push_back(v);
    return list;
  }
  for (const VarSymbol *v : static_cast<const PouSymbol *>(root.symbol)->variables) {
    if (root.isStatic ? v->section == Section::Stat : isOwn(v))
      list.push_back(v);
  }
  return list;
}

bool rootNeedsInit(Context &context, const Root &root) {
  if (root.symbol->library != context.own)
    return true;
  for (const VarSymbol *v : rootVariables(root)) {
    if (context.layouts.needsInit(v))
      return true;
  }
  return false;
}

bool rootHasLifecycle(Context &context, const Root &root, std::string_view lowerName) {
  if (root.symbol->kind == SymbolKind::Pou && !root.isStatic)
    return context.layouts.hasLifecycle(static_cast<const PouSymbol *>(root.symbol)->type,
                                        lowerName);
  for (const VarSymbol *v : rootVariables(root)) {
    if (v->section != Section::InOut && context.layouts.hasLifecycle(v->type, lowerName))
      return true;
  }
  return false;
}

std::vector<const Symbol *> headersOf(const Context &context) {
  const Library &library = *context.own;
  std::vector<const Symbol *> symbols;
  for (const auto &other : context.program.libraries)
    for (const TypeSymbol *t : other->types)
      if (other.get() != &library && t->onDemand && !library.isBuilt) // the project has them
        symbols.push_back(t);
  symbols.insert(symbols.end(), library.types.begin(), library.types.end());
  symbols.insert(symbols.end(), library.globals.begin(), library.globals.end());
  symbols.insert(symbols.end(), library.pous.begin(), library.pous.end());
  return symbols;
}

GeneratedFile generateHeader(Context &context, const Symbol *symbol) {
  HeaderBuilder builder(context);
  switch (symbol->kind) {
  case SymbolKind::Type: {
    const auto *t = static_cast<const TypeSymbol *>(symbol);
    if (t->type->kind == TypeKind::Structure && t->decl != nullptr &&
        t->decl->kind == DeclKind::Structure)
      return builder.structure(t);
    const bool own =
        t->type->kind == TypeKind::Enumeration && typeAs<EnumType>(t->type)->symbol == t;
    return own ? builder.enumeration(t) : builder.alias(t);
  }
  case SymbolKind::Globals:
    return builder.globals(static_cast<const GlobalsSymbol *>(symbol));
  default: {
    const auto *p = static_cast<const PouSymbol *>(symbol);
    return p->isFunction()    ? builder.function(p)
           : p->isInterface() ? builder.interface(p)
                              : builder.block(p);
  }
  }
}

} // namespace stc::codegen
