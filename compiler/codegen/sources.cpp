// Sources: one per POU, one for the initial values of structures and variable lists.

#include "compiler/codegen/inlining.hpp"
#include "compiler/codegen/units.hpp"
#include "compiler/semantics/hierarchy.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

std::string_view sourcePrelude() {
  // The warnings are about what the ST says (`x = x`, an unused variable), not about how it was
  // translated.
  return "#include \"runtime/iec/ops.h\"\n"
         "\n"
         "#pragma GCC diagnostic ignored \"-Wtautological-compare\"\n"
         "#pragma GCC diagnostic ignored \"-Wtype-limits\"\n"
         "#pragma GCC diagnostic ignored \"-Waddress\"\n"
         "#pragma GCC diagnostic ignored \"-Wunused-but-set-variable\"\n"
         "#pragma GCC diagnostic ignored \"-Wunused-but-set-parameter\"\n";
}

namespace {

/// Variables that one function initialises: g++ takes long for long functions, more than twice as
/// long for twice the length.
constexpr std::size_t kMostInits = 200;

class SourceBuilder {
public:
  SourceBuilder(Context &context, const PouSymbol *pou, std::string path)
      : c_(context), e_(context, pou), text_(context.program.sources), path_(std::move(path)) {}

  /// `void X::init__(…) { … }` for the given variables; nothing when they are zero.
  void init(std::string_view name, const std::vector<const VarSymbol *> &variables,
            const Type *base = nullptr, const PouSymbol *block = nullptr) {
    e_.forgetUses();
    e_.writer().indent();
    if (base != nullptr && c_.layouts.needsInit(base)) {
      e_.needContext();
      e_.writer().line() << "this->base__.init__(ctx__);";
      e_.writer().endLine();
    }
    if (block != nullptr && hasTypeId(block)) {
      e_.writer().line() << "this->" << pathToTypeId(block) << " = " << c_.names.typeId(block)
                         << "U;";
      e_.writer().endLine();
    }
    const bool inParts = variables.size() > kMostInits;
    std::size_t part = 0;
    for (std::size_t i = 0; i < variables.size();) {
      const std::span<const VarSymbol *const> rest = std::span(variables).subspan(i);
      if (inParts && part == 0)
        generatedLine("[&]() __attribute__((noinline)) {");
      const std::size_t run = e_.initRun(rest, name);
      if (run == 0 && c_.layouts.needsInit(rest[0]))
        e_.initVariable("this->" + fieldName(rest[0]), rest[0]);
      i += run == 0 ? 1 : run;
      part = (part + 1) % kMostInits;
      if (inParts && (part == 0 || i == variables.size()))
        generatedLine("}();");
    }
    const Writer body = e_.takeWriter();
    functionHead("void " + std::string(name) + "::init__(::stride::Ctx &" +
                 (e_.usesContext() ? "ctx__" : "") + ")");
    prologue();
    text_.append(body);
    text_.sameLine(); // not that of the body's first statement
    functionEnd();
  }

  /// `void X::assign__(…) { … }`: everything but the bindings of in-outs.
  void assignment(std::string_view name, const std::vector<const VarSymbol *> &variables,
                  const Type *base) {
    Writer body(c_.program.sources);
    body.indent();
    const auto copy = [&](const std::string &field, const Type *type) {
      const bool bindings = c_.layouts.hasBindings(type);
      body.line() << (bindings ? "::stride::assignBound(" : "") << "this->" << field
                  << (bindings ? ", " : " = ") << "from." << field << (bindings ? ");" : ";");
      body.endLine();
    };
    if (base != nullptr)
      copy("base__", base);
    for (const VarSymbol *v : variables) {
      e_.includes().complete(v->type);
      // An instance keeps its places in the process image, too.
      if (v->section != Section::inOut && isField(v) && !isSlot(v))
        copy(fieldName(v), v->type);
    }
    functionHead("void " + std::string(name) + "::assign__([[maybe_unused]] const " +
                 std::string(name) + " &from)");
    text_.append(body);
    functionEnd();
  }

  /// `void configure__(…)`: the initial values that VAR_CONFIG gives.
  void configured() {
    e_.forgetUses();
    e_.writer().indent();
    for (const SlotPlace &entry : c_.program.slotPlaces) {
      if (entry.decl->init != nullptr)
        e_.initConfigured(entry);
    }
    const Writer body = e_.takeWriter();
    functionHead(std::string("void configure__(::stride::Ctx &") +
                 (e_.usesContext() ? "ctx__" : "") + ")");
    prologue();
    text_.append(body);
    text_.sameLine(); // not that of the body's first statement
    functionEnd();
  }

  void blockBody(const PouSymbol *pou, std::string_view name) {
    e_.forgetUses();
    e_.writer().indent();
    e_.block(pou->decl->body);
    const Writer body = e_.takeWriter();
    const Writer locals = temporaries(pou);
    Writer bound(c_.program.sources);
    bound.indent();
    const Span start = startOf(pou);
    for (const VarSymbol *v : pou->variables) {
      if (v->section != Section::inOut || !e_.used(v))
        continue;
      bound.from(start);
      inOutReference(bound, v);
    }
    functionHead("void " + std::string(name) + "::body__(::stride::Ctx &" +
                     (e_.usesContext() ? "ctx__" : "") + ")",
                 start);
    prologue();
    text_.append(bound);
    budget();
    text_.append(locals);
    text_.append(body);
    budgetDone();
    functionEnd();
    pieces_.back().isBody = true;
  }

  /// `void X::exit__(…) { … }` or reinit__ of what the variables hold; `block` comes with its base.
  void lifecycle(std::string_view name, const std::vector<const VarSymbol *> &variables,
                 std::string_view what, const Type *base, const PouSymbol *block) {
    e_.forgetUses();
    e_.writer().indent();
    e_.lifecycle(variables, what, base, block);
    const Writer body = e_.takeWriter();
    functionHead("void " + std::string(name) + "::" + std::string(what.substr(3)) +
                 "__(::stride::Ctx &ctx__)");
    prologue();
    text_.append(body);
    text_.sameLine(); // not that of the body's first statement
    functionEnd();
  }

  void functionBody(const PouSymbol *pou) {
    const PouSymbol *outer = e_.enter(pou);
    e_.forgetUses();
    e_.writer().indent();
    e_.block(pou->decl->body);
    const Writer body = e_.takeWriter();
    e_.writer().indent();
    if (pou->result != nullptr)
      e_.declareLocal(pou->result, startOf(pou));
    for (const VarSymbol *v : pou->variables) {
      if (v->section == Section::input)
        e_.declareInput(v, startOf(pou));
      else if (v->section == Section::output && c_.layouts.needsInit(v))
        e_.initVariable(mangle(v->name.text), v);
      else if (v->section == Section::local || v->section == Section::temp)
        e_.declareLocal(v, startOf(pou));
    }
    const Writer locals = e_.takeWriter();
    if (pou->isMethod()) {
      for (const VarSymbol *p : pou->parameters())
        e_.includes().complete(p->type);
      std::string_view block = c_.names.local(pou->owner);
      functionHead(methodSignature(c_, e_.includes(), pou,
                                   std::string(block) + "::" + methodName(pou), false, &e_),
                   startOf(pou));
    } else {
      functionHead(functionSignature(c_, pou, &e_), startOf(pou));
    }
    prologue();
    budget();
    text_.append(locals);
    text_.append(body);
    budgetDone();
    if (pou->result != nullptr) {
      text_.line() << "  return " << mangle(pou->result->name.text) << ';';
      text_.endLine();
    }
    functionEnd();
    pieces_.back().isBody = !pou->isMethod();
    e_.enter(outer);
  }

  [[nodiscard]] Emitter &emitter() { return e_; }
  [[nodiscard]] bool empty() const { return text_.size() == 0; }

  /// The body once more, for those who call it.
  GeneratedFile inlined(const PouSymbol *own) {
    const std::string path = c_.names.inlineHeader(own);
    Writer file(c_.program.sources);
    lines(file, banner(std::string(own->name.text) + ", to be inlined") +
                    "#pragma once\n#include \"" + std::string(c_.names.header(own)) +
                    "\"\n#ifdef __OPTIMIZE__\n" + e_.includes().text(own, false) +
                    std::string(sourcePrelude()) +
                    "\nnamespace st::" + std::string(c_.names.space(c_.own)) + " {\n");
    for (const Piece &piece : pieces_) {
      if (!piece.isBody)
        continue;
      file.blank();
      lines(file, "__attribute__((gnu_inline)) inline\n");
      file.append(piece.text);
      file.fromGenerated(path);
    }
    lines(file, "} // namespace st::" + std::string(c_.names.space(c_.own)) + "\n#endif\n");
    return {path, file.take()};
  }

  GeneratedFile finish(const Symbol *own, std::string_view what) {
    Writer file(c_.program.sources);
    std::string head = banner(what);
    if (own != nullptr)
      head += "#include \"" + std::string(c_.names.header(own)) + "\"\n";
    // The sources of a library become one translation unit.
    head += e_.includes().text(own, true, c_.own->isUser ? nullptr : c_.own);
    head += sourcePrelude();
    head += "\nnamespace st::" + std::string(c_.names.space(c_.own)) + " {\n";
    lines(file, head);
    for (Piece &piece : pieces_) {
      file.blank();
      file.append(piece.text);
      file.fromGenerated(path_);
    }
    file << "} // namespace st::" << c_.names.space(c_.own);
    file.endLine();
    return {path_, file.take()};
  }

private:
  struct Piece {
    Writer text;
    bool isBody = false;
  };

  /// Between initial values; it counts as a line of the ST as the one before it does.
  void generatedLine(std::string_view text) {
    e_.writer().sameLine();
    e_.writer().line() << text;
    e_.writer().endLine();
  }

  /// Line by line, to count them.
  static void lines(Writer &file, std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t lineEnd = text.find('\n', at);
      file << text.substr(at, lineEnd - at);
      file.endLine();
      at = lineEnd + 1;
    }
  }

  /// Where the body begins: what stands in front of it in the C++ counts as that place, so that a
  /// debugger enters a POU at its first statement.
  static Span startOf(const PouSymbol *pou) {
    return pou->decl->body.empty() ? Span() : pou->decl->body.front()->span;
  }

  void functionHead(const std::string &signature, Span start = {}) {
    text_ = Writer(c_.program.sources);
    start_ = start;
    headLine() << signature << " {";
    text_.endLine();
  }

  /// A line in front of the body's own.
  Writer &headLine() {
    text_.from(start_);
    return text_.line();
  }

  void functionEnd() {
    text_.line() << '}';
    text_.endLine();
    pieces_.push_back({std::move(text_)});
    text_ = Writer(c_.program.sources);
  }

  void prologue() {
    std::size_t i = 0;
    for (const FileId file : e_.takeFiles()) {
      headLine() << "  constexpr const char *" << Emitter::fileConstant(i++) << " = \""
                 << escaped(c_.program.sources.file(file).codeName()) << "\";";
      text_.endLine();
    }
    for (const Emitter::RootUse &use : e_.takeRoots()) {
      headLine() << "  auto &" << use.reference << " = ::stride::root<"
                 << rootType(c_.names, use.root) << ">(ctx__, " << rootPlace(c_.names, use.root)
                 << ");";
      text_.endLine();
    }
    const unsigned areas = e_.takeAreas();
    for (unsigned area = 0; area < 3; ++area) {
      if ((areas >> area & 1U) == 0)
        continue;
      const char letter = "iqm"[area];
      headLine() << "  ::stride::BYTE *const image__" << letter
                 << " = ::stride::area(ctx__, ::st::image__" << letter << "__at__);";
      text_.endLine();
    }
  }

  void budget() {
    if (!e_.usesBudget())
      return;
    headLine() << "  ::stride::LoopBudget budget__(ctx__);";
    text_.endLine();
  }

  void budgetDone() {
    if (!e_.usesBudget())
      return;
    text_.line() << "  budget__.done(ctx__);";
    text_.endLine();
  }

  Writer temporaries(const PouSymbol *pou) {
    e_.writer().indent();
    for (const VarSymbol *v : pou->variables) {
      if (v->section == Section::temp)
        e_.declareLocal(v, startOf(pou));
    }
    return e_.takeWriter();
  }

  void inOutReference(Writer &out, const VarSymbol *v) {
    e_.includes().complete(v->type);
    const std::string name = mangle(v->name.text);
    const std::string_view type = c_.names.type(v->type);
    const bool open = v->type->kind == TypeKind::openArray; // the slot holds it itself
    out.line() << type << (type.back() == '*' ? "&" : " &") << name << " = ";
    if (e_.checks()) {
      e_.needContext();
      const Place at = out.place(v->name.span);
      out << "::stride::bound(ctx__, this->" << name << ", " << e_.fileName(v->name.span.file)
          << ", " << at.line << ", " << at.column << ");";
    } else {
      out << (open ? "this->" : "*this->") << name << ';';
    }
    out.endLine();
  }

  Context &c_;
  Emitter e_;
  Writer text_;
  Span start_; ///< of the function that is being written
  std::string path_;
  std::vector<Piece> pieces_;
};

void statics(Context &context, SourceBuilder &source, const PouSymbol *pou) {
  const Root root{pou, true};
  for (const std::string_view what : {std::string_view("fb_exit"), std::string_view("fb_reinit")}) {
    if (!hasStatics(pou) || !rootHasLifecycle(context, root, what))
      continue;
    std::string name = rootType(context.names, root);
    name.erase(0, name.rfind(':') + 1);
    source.lifecycle(name, rootVariables(root), what, nullptr, nullptr);
  }
  if (hasStatics(pou) && rootNeedsInit(context, root)) {
    std::string name = rootType(context.names, root);
    name.erase(0, name.rfind(':') + 1);
    source.init(name, rootVariables(root));
  }
}

} // namespace

bool hasConfiguredValues(const Program &program) {
  return std::any_of(program.slotPlaces.begin(), program.slotPlaces.end(),
                     [](const SlotPlace &entry) { return entry.decl->init != nullptr; });
}

void generateSources(Context &context, std::vector<GeneratedFile> &files) {
  const Library &library = *context.own;
  const std::string folder = std::string(context.names.space(&library)) + "/";
  SourceBuilder types(context, nullptr, folder + "init__.cpp");
  bool any = false;
  for (const TypeSymbol *t : library.types) {
    if (t->type->kind != TypeKind::structure || t->decl == nullptr ||
        t->decl->kind != DeclKind::structure || t->onDemand)
      continue;
    const auto *type = typeAs<StructType>(t->type);
    types.emitter().includes().symbol(t);
    if (context.layouts.hasBindings(type)) {
      types.assignment(context.names.local(t), {type->fields.begin(), type->fields.end()},
                       type->base);
      any = true;
    }
    if (!context.layouts.needsInit(t->type))
      continue;
    types.init(context.names.local(t), initialisedFields(type), type->base);
    any = true;
  }
  for (const std::string_view what : {std::string_view("fb_exit"), std::string_view("fb_reinit")}) {
    for (const TypeSymbol *t : library.types) {
      if (t->type->kind != TypeKind::structure || t->decl == nullptr ||
          t->decl->kind != DeclKind::structure || !context.layouts.hasLifecycle(t->type, what))
        continue;
      const auto *type = typeAs<StructType>(t->type);
      types.emitter().includes().symbol(t);
      types.lifecycle(context.names.local(t), {type->fields.begin(), type->fields.end()}, what,
                      type->base, nullptr);
      any = true;
    }
    for (const GlobalsSymbol *g : library.globals) {
      if (!rootHasLifecycle(context, {g, false}, what))
        continue;
      types.emitter().includes().symbol(g);
      types.lifecycle(context.names.local(g), rootVariables({g, false}), what, nullptr, nullptr);
      any = true;
    }
  }
  for (const GlobalsSymbol *g : library.globals) {
    if (!rootNeedsInit(context, {g, false}))
      continue;
    types.emitter().includes().symbol(g);
    types.init(context.names.local(g), rootVariables({g, false}));
    any = true;
  }
  if (library.isUser && hasConfiguredValues(context.program)) {
    types.configured();
    any = true;
  }
  if (any)
    files.push_back(types.finish(nullptr, "Initial values"));
  for (const PouSymbol *p : library.pous) {
    if (p->isInterface())
      continue;
    std::string path(context.names.header(p));
    path = path.substr(3, path.size() - 4) + "cpp"; // st/user/Main.h: user/Main.cpp
    SourceBuilder source(context, p, path);
    const bool external = p->decl->external;
    bool used = !external;
    const std::string_view name = context.names.local(p);
    if (!p->isFunction() && context.layouts.needsInit(p->type)) {
      source.init(name, rootVariables({p, false}), p->base == nullptr ? nullptr : p->base->type, p);
      used = true;
    }
    if (!p->isFunction() && p->type->kind == TypeKind::functionBlock &&
        context.layouts.hasBindings(p->type)) {
      source.assignment(name, rootVariables({p, false}),
                        p->base == nullptr ? nullptr : p->base->type);
      used = true;
    }
    for (const std::string_view what :
         {std::string_view("fb_exit"), std::string_view("fb_reinit")}) {
      if (!p->isFunction() && context.layouts.hasLifecycle(p->type, what)) {
        source.lifecycle(name, rootVariables({p, false}), what, nullptr, p);
        used = true;
      }
    }
    if (hasStatics(p)) {
      statics(context, source, p);
      used = true;
    }
    for (const PouSymbol *m : p->methods) {
      statics(context, source, m);
      used = used || hasStatics(m) || (!m->isAbstract() && !m->decl->external);
    }
    if (!used)
      continue;
    if (!external) {
      if (p->isFunction())
        source.functionBody(p);
      else if (p->decl->kind != DeclKind::classD)
        source.blockBody(p, name);
    }
    if (isInlinable(p))
      files.push_back(source.inlined(p));
    for (const PouSymbol *m : p->methods) {
      if (!m->isAbstract() && !m->decl->external)
        source.functionBody(m);
    }
    files.push_back(source.finish(p, p->name.text));
  }
}

} // namespace stc::codegen
