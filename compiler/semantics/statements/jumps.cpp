// JMP, labels, __TRY.

#include "compiler/semantics/statements/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/source/suggest.hpp"
#include "compiler/syntax/visit.hpp"

#include <unordered_map>

namespace stc::sema {

using namespace ast;

namespace {

/// The labels and jumps of one body, each with the blocks around it from outside to inside.
class Jumps {
public:
  struct Label {
    LabelStmt *stmt;
    std::vector<std::pair<unsigned, std::string_view>> blocks;
  };
  struct Jump {
    JumpStmt *stmt;
    std::vector<std::pair<unsigned, std::string_view>> blocks;
  };

  void collect(Block block) {
    for (Stmt *s : block)
      collect(s);
  }

  std::vector<Label> labels;
  std::vector<Jump> jumps;

private:
  void inside(Block block, std::string_view what) {
    if (block.empty())
      return;
    path_.emplace_back(++next_, what);
    collect(block);
    path_.pop_back();
  }

  /// What a block of the statement is called.
  static std::string_view wordOf(StmtKind kind) {
    switch (kind) {
    case StmtKind::If:
      return "IF";
    case StmtKind::Case:
      return "CASE";
    case StmtKind::For:
      return "FOR";
    case StmtKind::While:
      return "WHILE";
    case StmtKind::RepeatS:
      return "REPEAT";
    default:
      return {};
    }
  }

  void collect(Stmt *s) {
    if (s->kind == StmtKind::Label)
      labels.push_back({as<LabelStmt>(s), path_});
    if (s->kind == StmtKind::Jump)
      jumps.push_back({as<JumpStmt>(s), path_});
    if (s->kind == StmtKind::Try) {
      const auto *t = as<TryStmt>(s);
      inside(t->body, "__TRY");
      inside(t->catchBody, "__CATCH");
      inside(t->finallyBody, "__FINALLY");
      return;
    }
    forEachChild(
        s, [](Expr *) {}, [&](Block block) { inside(block, wordOf(s->kind)); });
  }

  std::vector<std::pair<unsigned, std::string_view>> path_;
  unsigned next_ = 0;
};

} // namespace

void checkJumps(Context &c, Block body) {
  Jumps found;
  found.collect(body);
  std::unordered_map<Ident, const Jumps::Label *> labels;
  for (const Jumps::Label &label : found.labels) {
    const auto [it, fresh] = labels.emplace(label.stmt->label.id, &label);
    if (!fresh)
      c.report(Code::RepeatedLabel, label.stmt->label.span,
               "the label `" + std::string(label.stmt->label.text) + "` is there twice",
               "again here")
          .label(it->second->stmt->label.span, "first here")
          .help("rename one of them: JMP could lead to either");
  }
  for (const Jumps::Jump &jump : found.jumps) {
    const Name &name = jump.stmt->label;
    const auto it = labels.find(name.id);
    if (it == labels.end()) {
      auto &d = c.report(Code::UnknownLabel, name.span,
                         "cannot find the label `" + std::string(name.text) + "`",
                         "no such label in this body");
      std::vector<std::string_view> candidates;
      for (const Jumps::Label &label : found.labels)
        candidates.push_back(label.stmt->label.text);
      if (const auto similar = nearest(name.text, candidates); !similar.empty())
        d.help("a similar one exists: `" + std::string(similar) + "`");
      else
        d.help("write `" + std::string(name.text) + ":` before the statement to go on with");
      continue;
    }
    const Jumps::Label &label = *it->second;
    label.stmt->used = true;
    jump.stmt->target = label.stmt;
    const auto [inLabel, inJump] = std::mismatch(label.blocks.begin(), label.blocks.end(),
                                                 jump.blocks.begin(), jump.blocks.end());
    if (inLabel == label.blocks.end())
      continue;
    c.report(Code::JumpIntoBlock, name.span,
             "JMP cannot lead into " + std::string(inLabel->second) + " from outside",
             "the label lies inside of another statement")
        .label(label.stmt->label.span, "this label")
        .help("move the label before the " + std::string(inLabel->second) +
              ", or the jump into it");
  }
  for (const Jumps::Label &label : found.labels)
    if (!label.stmt->used && labels.at(label.stmt->label.id) == &label)
      c.report(Code::UnusedLabel, label.stmt->label.span,
               "no JMP leads to the label `" + std::string(label.stmt->label.text) + "`",
               "not used")
          .help("remove it; a variable is declared in VAR … END_VAR");
}

void checkTry(Context &c, TryStmt *stmt) {
  checkBlock(c, stmt->body);
  if (stmt->exception != nullptr) {
    const Type *type = check(c, stmt->exception);
    if (!isError(type) && requireVariable(c, stmt->exception, "store an exception in")) {
      const Type *base = underlying(type);
      if (base->kind != TypeKind::Udint && base->kind != TypeKind::Dword) {
        auto &d = c.report(Code::ExceptionVariable, stmt->exception->span,
                           "the variable of __CATCH cannot be " + typeName(type),
                           "expected `__SYSTEM.ExceptionCode`");
        d.help("declare it: `exc : __SYSTEM.ExceptionCode;`");
      }
    }
  }
  checkBlock(c, stmt->catchBody);
  checkBlock(c, stmt->finallyBody);
}

} // namespace stc::sema
