#include "compiler/codegen/statements/jumps.hpp"

#include "compiler/codegen/places/places.hpp"
#include "compiler/codegen/statements/statements.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

constexpr size_t kFirstLeave = 2;

std::string labelName(const LabelStmt *label) {
  return "label__" + std::string(label->label.id->lower);
}

/// Both lead to the same place.
bool sameLeave(const Stmt *a, const Stmt *b) {
  return a->kind == b->kind &&
         (a->kind != StmtKind::Jump || as<JumpStmt>(a)->target == as<JumpStmt>(b)->target);
}

} // namespace

void emitJump(EmitContext &cx, const JumpStmt *s) {
  if (s->target == nullptr || leaveTry(cx, s))
    return;
  cx.begin(s->span);
  if (s->target->span.begin <= s->span.begin) { // a loop
    cx.uses.budget = true;
    cx.out << "budget__.refill(--budget__.left <= 0, " << cx.ctx() << ", ";
    cx.position(s->span);
    cx.out << "); ";
  }
  cx.out << "goto " << labelName(s->target) << ';';
  cx.end();
}

void emitLabel(EmitContext &cx, const LabelStmt *s) {
  if (!s->used)
    return;
  cx.begin(s->span);
  cx.out << labelName(s) << ":;";
  cx.end();
}

bool leaveTry(EmitContext &cx, const Stmt *s) {
  if (cx.modes.tries.empty())
    return false;
  Try &frame = cx.modes.tries.back();
  switch (s->kind) {
  case StmtKind::Exit:
  case StmtKind::Continue:
    if (cx.modes.loops.around.size() > frame.loops)
      return false;
    break;
  case StmtKind::Jump:
    if (const Span target = as<JumpStmt>(s)->target->span;
        target.begin >= frame.stmt->span.begin && target.end <= frame.stmt->span.end)
      return false;
    break;
  default:
    break;
  }
  size_t which = 0;
  while (which < frame.leaves.size() && !sameLeave(frame.leaves[which], s))
    ++which;
  if (which == frame.leaves.size())
    frame.leaves.push_back(s);
  cx.begin(s->span);
  cx.out << "leave__" << frame.id << " = " << which + kFirstLeave << "; goto finally__" << frame.id
         << ';';
  cx.end();
  return true;
}

namespace {

/// The C++ of one __TRY; what belongs to it has its number in its names.
class TryBlocks {
public:
  TryBlocks(EmitContext &cx, const TryStmt *s)
      : cx_(cx), s_(s), id_(cx.number()), number_(std::to_string(id_)) {}

  void emit() {
    cx_.begin(s_->span);
    cx_.out << '{';
    cx_.end();
    cx_.open();
    cx_.line("unsigned leave__" + number_ + " = 0;");
    cx_.line("::stride::Caught caught__" + number_ + ";");
    if (s_->hasFinally)
      cx_.modes.tries.push_back({id_, s_, cx_.modes.loops.around.size(), {}});
    guarded(s_->body);
    if (s_->hasCatch)
      handler();
    if (s_->hasFinally)
      finally();
    if (s_->hasFinally || !s_->hasCatch)
      raiseAgain();
    leave();
    cx_.close();
    cx_.line("}");
  }

private:
  /// Statements whose exceptions are caught.
  template <class Write> void guard(Write &&write) {
    cx_.line("try {");
    cx_.open();
    write();
    cx_.close();
    cx_.line("} catch (...) {");
    cx_.open();
    cx_.out.line() << "::stride::caught(" << cx_.ctx() << ", caught__" << number_ << ");";
    cx_.end();
    cx_.line("leave__" + number_ + " = 1;");
    cx_.close();
    cx_.line("}");
  }

  void guarded(Block body) {
    guard([&] { emitBlock(cx_, body); });
  }

  void caught() {
    if (s_->exception != nullptr) {
      cx_.begin(s_->exception->span);
      emitPlace(cx_, s_->exception);
      cx_.out << " = static_cast<" << cx_.type(s_->exception->type)
              << ">(::stride::exceptionNumber(caught__" << number_ << ".code));";
      cx_.end();
    }
    emitBlock(cx_, s_->catchBody);
  }

  void handler() {
    cx_.line("if (leave__" + number_ + " == 1) {");
    cx_.open();
    cx_.line("leave__" + number_ + " = 0;");
    if (s_->hasFinally)
      guard([&] { caught(); });
    else
      caught();
    cx_.close();
    cx_.line("}");
  }

  void finally() {
    leaves_ = std::move(cx_.modes.tries.back().leaves);
    cx_.modes.tries.pop_back();
    if (!leaves_.empty())
      cx_.line("finally__" + number_ + ":;");
    cx_.line("{");
    cx_.open();
    emitBlock(cx_, s_->finallyBody);
    cx_.close();
    cx_.line("}");
  }

  void raiseAgain() {
    cx_.line("if (leave__" + number_ + " == 1)");
    cx_.out.line() << "  ::stride::raiseAgain(" << cx_.ctx() << ", caught__" << number_ << ");";
    cx_.end();
  }

  /// What the statements were left with happens now.
  void leave() {
    for (size_t i = 0; i < leaves_.size(); ++i) {
      cx_.out.line() << "if (leave__" << number_ << " == " << i + kFirstLeave << ") {";
      cx_.end();
      cx_.open();
      emitStatement(cx_, leaves_[i]);
      cx_.close();
      cx_.line("}");
    }
  }

  EmitContext &cx_;
  const TryStmt *s_;
  unsigned id_;
  std::string number_;
  std::vector<const Stmt *> leaves_;
};

} // namespace

void emitTry(EmitContext &cx, const TryStmt *s) { TryBlocks(cx, s).emit(); }

} // namespace stc::codegen
