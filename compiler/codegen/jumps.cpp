// JMP, labels, __TRY.
//
// __TRY is a C++ try, but what __CATCH and __FINALLY hold is written behind it: there may be jumps
// in them, and a fault of the memory guard must not leave a C++ handler open. `leave__N` says how
// the statements were left: 0 at their end, 1 with an exception, from 2 on with RETURN, EXIT,
// CONTINUE or JMP, which happens behind __FINALLY.

#include "compiler/codegen/emitter.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

constexpr std::size_t kFirstLeave = 2;

std::string labelName(const LabelStmt *label) {
  return "label__" + std::string(label->label.id->lower);
}

/// Both lead to the same place.
bool sameLeave(const Stmt *a, const Stmt *b) {
  return a->kind == b->kind &&
         (a->kind != StmtKind::jump || as<JumpStmt>(a)->target == as<JumpStmt>(b)->target);
}

} // namespace

void Emitter::jump(const JumpStmt *s) {
  if (s->target == nullptr || leaveTry(s))
    return;
  begin(s->span);
  if (s->target->span.begin <= s->span.begin) { // a loop
    usesBudget_ = true;
    w_ << "budget__.refill(--budget__.left <= 0, " << ctx() << ", ";
    position(s->span);
    w_ << "); ";
  }
  w_ << "goto " << labelName(s->target) << ';';
  end();
}

void Emitter::label(const LabelStmt *s) {
  if (!s->used)
    return;
  begin(s->span);
  w_ << labelName(s) << ":;";
  end();
}

bool Emitter::leaveTry(const Stmt *s) {
  if (tries_.empty())
    return false;
  Try &frame = tries_.back();
  switch (s->kind) {
  case StmtKind::exit:
  case StmtKind::continueS:
    if (loops_.size() > frame.loops)
      return false;
    break;
  case StmtKind::jump:
    if (const Span target = as<JumpStmt>(s)->target->span;
        target.begin >= frame.stmt->span.begin && target.end <= frame.stmt->span.end)
      return false;
    break;
  default:
    break;
  }
  std::size_t which = 0;
  while (which < frame.leaves.size() && !sameLeave(frame.leaves[which], s))
    ++which;
  if (which == frame.leaves.size())
    frame.leaves.push_back(s);
  begin(s->span);
  w_ << "leave__" << frame.id << " = " << which + kFirstLeave << "; goto finally__" << frame.id
     << ';';
  end();
  return true;
}

void Emitter::catchAll(unsigned id) {
  w_.line() << "} catch (...) {";
  end();
  open();
  w_.line() << "::stride::caught(" << ctx() << ", caught__" << id << ");";
  end();
  w_.line() << "leave__" << id << " = 1;";
  end();
  close();
  w_.line() << '}';
  end();
}

void Emitter::tryStatement(const TryStmt *s) {
  const unsigned id = ++next_;
  begin(s->span);
  w_ << '{';
  end();
  open();
  w_.line() << "unsigned leave__" << id << " = 0;";
  end();
  w_.line() << "::stride::Caught caught__" << id << ';';
  end();
  if (s->hasFinally)
    tries_.push_back({id, s, loops_.size(), {}});
  w_.line() << "try {";
  end();
  open();
  block(s->body);
  close();
  catchAll(id);
  if (s->hasCatch) {
    w_.line() << "if (leave__" << id << " == 1) {";
    end();
    open();
    w_.line() << "leave__" << id << " = 0;";
    end();
    if (s->hasFinally) {
      w_.line() << "try {";
      end();
      open();
    }
    if (s->exception != nullptr) {
      begin(s->exception->span);
      const std::string target = placeText(s->exception);
      w_ << target << " = static_cast<" << type(s->exception->type)
         << ">(::stride::exceptionNumber(caught__" << id << ".code));";
      end();
    }
    block(s->catchBody);
    if (s->hasFinally) {
      close();
      catchAll(id);
    }
    close();
    w_.line() << '}';
    end();
  }
  std::vector<const Stmt *> leaves;
  if (s->hasFinally) {
    leaves = std::move(tries_.back().leaves);
    tries_.pop_back();
    if (!leaves.empty()) {
      w_.line() << "finally__" << id << ":;";
      end();
    }
    w_.line() << '{';
    end();
    open();
    block(s->finallyBody);
    close();
    w_.line() << '}';
    end();
  }
  if (s->hasFinally || !s->hasCatch) {
    w_.line() << "if (leave__" << id << " == 1)";
    end();
    w_.line() << "  ::stride::raiseAgain(" << ctx() << ", caught__" << id << ");";
    end();
  }
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    w_.line() << "if (leave__" << id << " == " << i + kFirstLeave << ") {";
    end();
    open();
    statement(leaves[i]);
    close();
    w_.line() << '}';
    end();
  }
  close();
  w_.line() << '}';
  end();
}

} // namespace stc::codegen
