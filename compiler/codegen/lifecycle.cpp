// FB_Init, FB_Exit and FB_Reinit of instances.

#include "compiler/codegen/emitter.hpp"
#include "compiler/semantics/hierarchy.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

const PouSymbol *ownMethod(const PouSymbol *block, std::string_view lower) {
  for (const PouSymbol *m : block->methods) {
    if (m->property == nullptr && block->isBlock() && m->name.id->lower == lower)
      return m;
  }
  return nullptr;
}

/// The type as written, where it names a block; null: it does not.
const NamedTypeExpr *constructOf(const VarSymbol *variable) {
  if (variable->decl == nullptr || variable->decl->type == nullptr)
    return nullptr;
  const TypeExpr *type = variable->decl->type;
  while (type->kind == TypeExprKind::array)
    type = as<ArrayTypeExpr>(type)->element;
  return type->kind == TypeExprKind::named ? as<NamedTypeExpr>(type) : nullptr;
}

} // namespace

/// Something for each instance in (the arrays of) `target`; `each` gets its place and its number.
void Emitter::eachInstance(std::string_view target, const Type *type,
                           const std::function<void(std::string_view)> &each) {
  if (type->kind != TypeKind::array) {
    each(target);
    return;
  }
  const std::string element = temporary("element");
  begin(initSpan_);
  w_ << "for (auto &" << element << " : " << target << ".v) {";
  end();
  open();
  eachInstance(element, typeAs<ArrayType>(type)->element, each);
  close();
  begin(initSpan_);
  w_ << '}';
  end();
}

/// The FB_Inits of one instance, the base's first.
void Emitter::callInit(std::string_view target, const PouSymbol *block,
                       std::span<const Argument> arguments) {
  std::vector<const PouSymbol *> chain;
  for (const PouSymbol *p = block; p != nullptr; p = p->base)
    chain.push_back(p);
  for (std::size_t i = chain.size(); i-- > 0;) {
    const PouSymbol *init = ownMethod(chain[i], "fb_init");
    if (init == nullptr)
      continue;
    begin(initSpan_);
    w_ << target << '.' << pathToBase(block, chain[i]) << methodName(init) << '(' << ctx()
       << ", ctx__.keepRetains == 0, ctx__.inCopyCode";
    for (const VarSymbol *p : constructInputs(chain[i])) {
      w_ << ", ";
      const Argument *given = nullptr;
      for (const Argument &a : arguments) {
        if (a.parameter != nullptr && a.parameter->name.id == p->name.id)
          given = &a;
      }
      if (given == nullptr || given->value == nullptr)
        defaultArgument(p);
      else if (given->value->kind == ExprKind::aggregate)
        aggregateValue(p->type, given->value);
      else if (p->type->kind == TypeKind::reference)
        addressAs(given->value, typeAs<PointerType>(p->type)->pointee);
      else
        valueAs(given->value, p->type);
    }
    w_ << ");";
    end();
  }
}

void Emitter::construct(std::string_view target, const VarSymbol *variable) {
  const Type *type = innermost(variable->type);
  if (type->kind != TypeKind::functionBlock)
    return;
  const PouSymbol *block = typeAs<PouType>(type)->symbol;
  if (findInit(block) == nullptr)
    return;
  const NamedTypeExpr *written = constructOf(variable);
  if (written == nullptr || written->elements.empty()) {
    const std::span<const Argument> arguments =
        written == nullptr ? std::span<const Argument>() : written->arguments;
    eachInstance(target, variable->type,
                 [&](std::string_view each) { callInit(each, block, arguments); });
    return;
  }
  // One list of inputs for each element: they are written one after the other.
  std::uint64_t at = 0;
  const auto walk = [&](auto &&go, const std::string &place, const Type *t) -> void {
    if (t->kind != TypeKind::array) {
      callInit(place, block,
               at < written->elements.size() ? written->elements[at] : std::span<Argument>());
      ++at;
      return;
    }
    for (std::uint64_t i = 0; i < typeAs<ArrayType>(t)->count(); ++i)
      go(go, place + ".v[" + std::to_string(i) + "]", typeAs<ArrayType>(t)->element);
  };
  walk(walk, std::string(target), variable->type);
}

/// FB_Init of instances that come without a declaration of their own.
void Emitter::constructPlain(std::string_view target, const Type *type) {
  const Type *element = innermost(type);
  if (element->kind != TypeKind::functionBlock ||
      findInit(typeAs<PouType>(element)->symbol) == nullptr)
    return;
  eachInstance(target, type, [&](std::string_view each) {
    callInit(each, typeAs<PouType>(element)->symbol, {});
  });
}

/// {attribute 'call_after_init'}
void Emitter::afterInit(std::string_view target, const Type *type) {
  const Type *element = innermost(type);
  if (element->kind != TypeKind::functionBlock)
    return;
  const PouSymbol *block = typeAs<PouType>(element)->symbol;
  const std::vector<PouSymbol *> methods = afterInitMethods(block);
  if (methods.empty())
    return;
  eachInstance(target, type, [&](std::string_view each) {
    for (const PouSymbol *m : methods) {
      begin(initSpan_);
      bool outputs = false;
      for (const VarSymbol *p : m->parameters())
        outputs = outputs || p->section == Section::output;
      if (outputs)
        w_ << "{ ";
      std::string arguments;
      for (const VarSymbol *p : m->parameters()) {
        if (p->section == Section::output) {
          const std::string out = temporary("out");
          w_ << this->type(p->type) << ' ' << out << "{}; ";
          arguments += ", " + out;
        } else {
          const std::size_t start = w_.size();
          defaultArgument(p);
          arguments += ", " + w_.cut(start);
        }
      }
      w_ << each << '.' << pathToBase(block, m->owner) << methodName(m) << '(' << ctx() << arguments
         << ");" << (outputs ? " }" : "");
      end();
    }
  });
}

/// What exit__ and reinit__ do with one variable.
void Emitter::lifecycleOf(std::string_view target, const Type *type, std::string_view what) {
  if (!c_.layouts.hasLifecycle(type, what))
    return;
  includes_.complete(innermost(type));
  eachInstance(target, type, [&](std::string_view each) {
    begin(initSpan_);
    w_ << each << '.' << what.substr(3) << "__(" << ctx() << ");";
    end();
  });
}

void Emitter::lifecycle(const std::vector<const VarSymbol *> &variables, std::string_view what,
                        const Type *base, const PouSymbol *block) {
  const bool isExit = what == "fb_exit";
  const auto members = [&](const std::vector<const VarSymbol *> &list, const std::string &path) {
    for (const VarSymbol *v : list) {
      if (v->section == Section::inOut)
        continue;
      initSpan_ = v->name.span;
      lifecycleOf(path + fieldName(v), v->type, what);
    }
  };
  const auto own = [&](const PouSymbol *at) {
    const PouSymbol *method = ownMethod(at, what);
    if (method == nullptr)
      return false;
    begin(method->name.span);
    w_ << "this->" << pathToBase(block, at) << methodName(method) << '(' << ctx()
       << (isExit ? ", ctx__.inCopyCode);" : ");");
    end();
    return true;
  };
  // FB_Exit: derived before base, the owner before what it holds. FB_Reinit: the other way round,
  // and only the last one (it calls its base's itself).
  if (block != nullptr && isExit) {
    for (const PouSymbol *p = block; p != nullptr; p = p->base)
      own(p);
  }
  if (base != nullptr && c_.layouts.hasLifecycle(base, what)) {
    begin(initSpan_);
    w_ << "this->base__." << what.substr(3) << "__(" << ctx() << ");";
    end();
  }
  if (block == nullptr) {
    members(variables, "this->");
    return;
  }
  for (const PouSymbol *p = block; p != nullptr; p = p->base) {
    std::vector<const VarSymbol *> fields;
    for (const VarSymbol *v : p->variables) {
      if (isField(v))
        fields.push_back(v);
    }
    members(fields, "this->" + pathToBase(block, p));
  }
  if (!isExit) {
    for (const PouSymbol *p = block; p != nullptr; p = p->base) {
      if (own(p))
        break;
    }
  }
}

/// FB_Exit of a local variable, at the end of the call.
void Emitter::exitAtEnd(const VarSymbol *variable) {
  if (!c_.layouts.hasLifecycle(variable->type, "fb_exit"))
    return;
  initSpan_ = variable->name.span;
  begin(initSpan_);
  w_ << "const ::stride::AtEnd " << temporary("end") << "{[&] {";
  end();
  open();
  lifecycleOf(mangle(variable->name.text), variable->type, "fb_exit");
  close();
  begin(initSpan_);
  w_ << "}};";
  end();
}

} // namespace stc::codegen
