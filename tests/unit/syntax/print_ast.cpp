#include "tests/unit/syntax/print_ast.hpp"

#include "tests/unit/syntax/print_expression.hpp"

#include <sstream>

namespace stc::test {

using namespace ast;

namespace {

class Printer : public ExpressionPrinter {
public:
  void block(Block list) {
    out_ << '{';
    for (const Stmt *one : list) {
      out_ << ' ';
      statement(one);
    }
    out_ << " }";
  }

  void statement(const Stmt *node) {
    switch (node->kind) {
    case StmtKind::Empty:
      out_ << "(;)";
      break;
    case StmtKind::Exit:
      out_ << "(exit)";
      break;
    case StmtKind::Continue:
      out_ << "(continue)";
      break;
    case StmtKind::Return:
      out_ << "(return)";
      break;
    case StmtKind::Jump:
      out_ << "(jmp " << as<JumpStmt>(node)->label.text << ')';
      break;
    case StmtKind::Label:
      out_ << "(label " << as<LabelStmt>(node)->label.text << ')';
      break;
    case StmtKind::Try: {
      const auto *s = as<TryStmt>(node);
      out_ << "(try ";
      block(s->body);
      if (s->hasCatch) {
        out_ << " catch ";
        if (s->exception != nullptr)
          expression(s->exception);
        block(s->catchBody);
      }
      if (s->hasFinally) {
        out_ << " finally ";
        block(s->finallyBody);
      }
      out_ << ')';
      break;
    }
    case StmtKind::Assign: {
      static constexpr const char *kOps[] = {":=", "S=", "R=", "REF="};
      const auto *a = as<AssignStmt>(node);
      out_ << '(' << kOps[static_cast<size_t>(a->op)];
      for (const Expr *target : a->targets) {
        out_ << ' ';
        expression(target);
      }
      out_ << ' ';
      expression(a->value);
      out_ << ')';
      break;
    }
    case StmtKind::Call:
      expression(as<CallStmt>(node)->expr);
      break;
    case StmtKind::If: {
      const auto *s = as<IfStmt>(node);
      out_ << "(if";
      for (const IfBranch &branch : s->branches) {
        out_ << ' ';
        expression(branch.condition);
        out_ << ' ';
        block(branch.body);
      }
      if (s->hasElse) {
        out_ << " else ";
        block(s->elseBody);
      }
      out_ << ')';
      break;
    }
    case StmtKind::Case: {
      const auto *s = as<CaseStmt>(node);
      out_ << "(case ";
      expression(s->selector);
      for (const CaseBranch &branch : s->branches) {
        for (const CaseLabel &label : branch.labels) {
          out_ << ' ';
          expression(label.low);
          if (label.high != nullptr) {
            out_ << "..";
            expression(label.high);
          }
        }
        out_ << ' ';
        block(branch.body);
      }
      if (s->hasElse) {
        out_ << " else ";
        block(s->elseBody);
      }
      out_ << ')';
      break;
    }
    case StmtKind::For: {
      const auto *s = as<ForStmt>(node);
      out_ << "(for ";
      expression(s->variable);
      for (const Expr *part : {s->from, s->to, s->by}) {
        out_ << ' ';
        expression(part);
      }
      out_ << ' ';
      block(s->body);
      out_ << ')';
      break;
    }
    case StmtKind::While:
      out_ << "(while ";
      expression(as<WhileStmt>(node)->condition);
      out_ << ' ';
      block(as<WhileStmt>(node)->body);
      out_ << ')';
      break;
    case StmtKind::RepeatS:
      out_ << "(repeat ";
      block(as<RepeatStmt>(node)->body);
      out_ << ' ';
      expression(as<RepeatStmt>(node)->until);
      out_ << ')';
      break;
    }
  }

  void variables(std::span<VarDecl *> list) {
    static constexpr const char *kSections[] = {
        "VAR",          "VAR_INPUT",  "VAR_OUTPUT", "VAR_IN_OUT", "VAR_TEMP", "VAR_STAT",
        "VAR_EXTERNAL", "VAR_GLOBAL", "VAR_CONFIG", "VAR_ACCESS", "VAR_INST"};
    for (const VarDecl *one : list) {
      out_ << "\n  (" << kSections[static_cast<size_t>(one->section)];
      out_ << ((one->qualifiers & kQualConstant) != 0 ? " CONSTANT" : "");
      out_ << ((one->qualifiers & kQualRetain) != 0 ? " RETAIN" : "");
      out_ << ((one->qualifiers & kQualPersistent) != 0 ? " PERSISTENT" : "");
      out_ << ((one->qualifiers & kQualNonRetain) != 0 ? " NON_RETAIN" : "");
      out_ << (one->readOnly ? " READ_ONLY" : "") << (one->readWrite ? " READ_WRITE" : "");
      access(one->access);
      out_ << ' ';
      if (one->path == nullptr || one->section == Section::Access)
        out_ << one->name.text;
      if (one->path != nullptr) {
        out_ << '@';
        expression(one->path);
      }
      if (one->address != nullptr) {
        out_ << " AT ";
        address(one->address);
      }
      out_ << ' ';
      type(one->type);
      if (one->init != nullptr) {
        out_ << " := ";
        expression(one->init);
      }
      extras(one->attributes, one->doc);
      out_ << ')';
    }
  }

  void access(Access which) {
    static constexpr const char *kNames[] = {"", " PUBLIC", " PRIVATE", " PROTECTED", " INTERNAL"};
    out_ << kNames[static_cast<size_t>(which)];
  }

  void head(const Decl *node) {
    access(node->access);
    out_ << ((node->modifiers & kModAbstract) != 0 ? " ABSTRACT" : "");
    out_ << ((node->modifiers & kModFinal) != 0 ? " FINAL" : "");
    out_ << ((node->modifiers & kModOverride) != 0 ? " OVERRIDE" : "");
    if (node->name) {
      out_ << ' ';
      path(node->space);
      out_ << (node->space.empty() ? "" : "/") << node->name.text;
    }
    for (const NamePath &one : node->usings) {
      out_ << " USING ";
      path(one);
    }
    extras(node->attributes, node->doc);
  }

  void pou(const PouDecl *node) {
    if (!node->base.empty()) {
      out_ << " EXTENDS ";
      path(node->base);
    }
    for (const NamePath &one : node->interfaces) {
      out_ << " IMPLEMENTS ";
      path(one);
    }
    if (node->returnType != nullptr) {
      out_ << " : ";
      type(node->returnType);
    }
    out_ << (node->external ? " external" : "");
    variables(node->variables);
    for (const Stmt *one : node->body) {
      out_ << "\n  ";
      statement(one);
    }
    for (const auto &list : {node->methods, node->actions})
      for (const PouDecl *one : list) {
        out_ << "\n  ";
        declaration(one, ")");
      }
    for (const PropertyDecl *one : node->properties) {
      out_ << "\n  (PROPERTY";
      head(one);
      out_ << " : ";
      type(one->type);
      if (one->get != nullptr) {
        out_ << " GET";
        pou(one->get);
      }
      if (one->set != nullptr) {
        out_ << " SET";
        pou(one->set);
      }
      out_ << ')';
    }
  }

  void configuration(const ConfigurationDecl *node) {
    for (const ResourceDecl &resource : node->resources) {
      out_ << "\n  (RESOURCE " << resource.name.text;
      if (resource.processor)
        out_ << " ON " << resource.processor.text;
      for (const TaskDecl &task : resource.tasks) {
        out_ << "\n    (TASK " << task.name.text;
        arguments(task.arguments);
        out_ << ')';
      }
      for (const ProgramInstanceDecl &one : resource.programs) {
        out_ << "\n    (PROGRAM " << one.name.text;
        out_ << ((one.qualifiers & kQualRetain) != 0 ? " RETAIN" : "");
        out_ << ((one.qualifiers & kQualNonRetain) != 0 ? " NON_RETAIN" : "");
        if (one.task)
          out_ << " WITH " << one.task.text;
        out_ << " : ";
        path(one.type);
        arguments(one.arguments);
        out_ << ')';
      }
      out_ << ')';
    }
  }

  void extras(Attributes attributes, std::string_view doc) {
    for (const Attribute &attribute : attributes) {
      out_ << " {" << attribute.name;
      if (!attribute.value.empty())
        out_ << '=' << attribute.value;
      out_ << '}';
    }
    if (!doc.empty())
      out_ << " \"" << doc << '"';
  }

  void declaration(const Decl *node, const char *end = ")\n") {
    static constexpr const char *kKinds[] = {
        "PROGRAM", "FUNCTION",   "FUNCTION_BLOCK", "CLASS",      "INTERFACE",
        "METHOD",  "ACTION",     "PROPERTY",       "STRUCT",     "ENUM",
        "ALIAS",   "VAR_GLOBAL", "VAR_CONFIG",     "VAR_ACCESS", "CONFIGURATION"};
    out_ << '(' << kKinds[static_cast<size_t>(node->kind)];
    head(node);
    switch (node->kind) {
    case DeclKind::Program:
    case DeclKind::Function:
    case DeclKind::FunctionBlock:
    case DeclKind::Class:
    case DeclKind::Interface:
    case DeclKind::Method:
    case DeclKind::Action:
      pou(as<PouDecl>(node));
      break;
    case DeclKind::Structure:
      out_ << (as<StructDecl>(node)->isUnion ? " UNION" : "");
      if (!as<StructDecl>(node)->base.empty()) {
        out_ << " EXTENDS ";
        path(as<StructDecl>(node)->base);
      }
      variables(as<StructDecl>(node)->fields);
      break;
    case DeclKind::Enumeration:
      out_ << ' ';
      type(as<EnumDecl>(node)->type);
      if (as<EnumDecl>(node)->init != nullptr) {
        out_ << " := ";
        expression(as<EnumDecl>(node)->init);
      }
      break;
    case DeclKind::Alias:
      out_ << ' ';
      type(as<AliasDecl>(node)->type);
      if (as<AliasDecl>(node)->init != nullptr) {
        out_ << " := ";
        expression(as<AliasDecl>(node)->init);
      }
      break;
    case DeclKind::Configuration:
      configuration(as<ConfigurationDecl>(node));
      break;
    case DeclKind::Globals:
    case DeclKind::Config:
    case DeclKind::Access:
      variables(as<GlobalsDecl>(node)->variables);
      break;
    case DeclKind::Property:
      break; // printed by its block
    }
    out_ << end;
  }
};

std::string program(const std::string &statements) {
  return "PROGRAM P\n" + statements + "\nEND_PROGRAM\n";
}

} // namespace

std::string print(const File &file) {
  Printer printer;
  for (const Decl *one : file.declarations)
    printer.declaration(one);
  return printer.take();
}

std::string print(const Stmt *statement) {
  Printer printer;
  printer.statement(statement);
  return printer.take();
}

std::string print(const Expr *expression) {
  Printer printer;
  printer.expression(expression);
  return printer.take();
}

std::string print(const TypeExpr *type) {
  Printer printer;
  printer.type(type);
  return printer.take();
}

Parsed::Parsed(std::string text) {
  const FileId id = sources.addBytes("T.st", std::move(text));
  file = parse(sources.file(id), interner, arena, diagnostics);
  diagnostics.sort();
}

std::string Parsed::errors() const {
  std::ostringstream out;
  for (const Diagnostic &d : diagnostics.all()) {
    out << codeName(d.code) << ' ';
    if (!d.labels.empty()) {
      const LineColumn at = sources.position(d.labels.front().span);
      out << at.line << ':' << at.column << ' ';
    }
    out << d.message << '\n';
  }
  return out.str();
}

std::string Parsed::rendered() const {
  std::string out;
  for (const Diagnostic &d : diagnostics.all())
    out += renderText(d, sources);
  return out;
}

std::string printBody(const std::string &statements) {
  const Parsed parsed(program(statements));
  if (parsed.diagnostics.hasErrors())
    return parsed.rendered();
  std::string out;
  for (const Stmt *one : as<PouDecl>(parsed.file->declarations[0])->body)
    out += (out.empty() ? "" : "\n") + print(one);
  return out;
}

std::string printExpression(const std::string &expression) {
  const Parsed parsed(program("x := " + expression + ";"));
  if (parsed.diagnostics.hasErrors())
    return parsed.rendered();
  return print(as<AssignStmt>(as<PouDecl>(parsed.file->declarations[0])->body[0])->value);
}

std::string bodyErrors(const std::string &statements) {
  // The first line stands on the line of PROGRAM, so that lines count from 1.
  return Parsed("PROGRAM P " + statements + "\nEND_PROGRAM\n").errors();
}

} // namespace stc::test
