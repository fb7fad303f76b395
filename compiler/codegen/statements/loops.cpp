#include "compiler/codegen/statements/loops.hpp"

#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/places/places.hpp"
#include "compiler/codegen/statements/assignments.hpp"
#include "compiler/codegen/statements/statements.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/syntax/visit.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

/// RETURN, or (with `exits`) EXIT of the loop around: it may end before its last round.
bool mayLeave(Block block, bool exits) {
  bool leaves = false;
  for (const Stmt *s : block) {
    const bool isLoop =
        s->kind == StmtKind::For || s->kind == StmtKind::While || s->kind == StmtKind::RepeatS;
    if (s->kind == StmtKind::Return || (exits && s->kind == StmtKind::Exit))
      return true;
    if (s->kind != StmtKind::Try)
      forEachChild(
          s, [](const Expr *) {},
          [&](Block inner) { leaves = leaves || mayLeave(inner, exits && !isLoop); });
  }
  return leaves;
}

/// The outer one of a loop's two C++ loops.
void openRefillLoop(EmitContext &cx, std::string_view run, std::string_view first, Span span) {
  cx.uses.budget = true;
  cx.out << "for (bool " << run << " = " << first << "; " << run << "; budget__.refill(" << run
         << ", " << cx.ctx() << ", ";
  cx.position(span);
  cx.out << ")) ";
}

/// The body with its closing brace and, after it, the label that EXIT jumps to.
void emitLoopBody(EmitContext &cx, Block body, bool isDouble) {
  std::vector<Loop> &loops = cx.modes.loops.around;
  loops.push_back({cx.number(), isDouble});
  cx.open();
  emitBlock(cx, body);
  cx.close();
  cx.line("}");
  if (loops.back().labelled)
    cx.line("exit__" + std::to_string(loops.back().id) + ":;");
  loops.pop_back();
}

/// Nothing but the loop's own statements reaches the variable of the POU while it runs.
bool isReachedOnlyHere(EmitContext &cx, const VarSymbol *v) {
  if (contains(cx.modes.loops.locals, v))
    return true;
  return cx.pou != nullptr && cx.pou->isFunction() && v->owner == cx.pou &&
         v->section == Section::Local && !isIndirect(v) && v->location == nullptr &&
         !cx.run.analysis.isShared(v) && !cx.run.addressed.onDataStack(v);
}

/// While the body of a WHILE loop is written the range of a variable may be known.
class WhileRange {
public:
  WhileRange(EmitContext &cx, const WhileStmt *s, bool isKnown, int64_t uncounted)
      : analysis_(cx.run.analysis), uncounted_(cx.modes.loops.uncounted, uncounted) {
    if (isKnown)
      analysis_.enterWhile(s, cx.modes.before);
    else
      analysis_.enterUnknown();
  }
  ~WhileRange() { analysis_.leaveLoop(); }
  WhileRange(const WhileRange &) = delete;
  WhileRange &operator=(const WhileRange &) = delete;

private:
  Analysis &analysis_;
  Scoped<int64_t> uncounted_;
};

void emitWhile(EmitContext &cx, const WhileStmt *s) {
  Analysis &analysis = cx.run.analysis;
  const VarSymbol *v = Analysis::steppedVariable(s);
  const bool isKnown = v != nullptr && isReachedOnlyHere(cx, v);
  const int64_t most = Analysis::kShortLoop / cx.modes.loops.uncounted;
  const int64_t rounds = isKnown ? analysis.whileRounds(s, cx.modes.before) : most + 1;
  const bool isShort = rounds <= most;
  cx.begin(s->span);
  if (isShort) {
    cx.out << "while (";
    emitValue(cx, s->condition);
    cx.out << ") {";
  } else {
    const std::string run = cx.temporary("run");
    openRefillLoop(cx, run, "true", s->span);
    cx.out << "while (--budget__.left >= 0 && (" << run << " = ";
    emitValue(cx, s->condition);
    cx.out << ")) {";
  }
  cx.end();
  const WhileRange range(cx, s, isKnown, isShort ? cx.modes.loops.uncounted * rounds : 1);
  emitLoopBody(cx, s->body, !isShort);
}

void emitRepeat(EmitContext &cx, const RepeatStmt *s) {
  const std::string run = cx.temporary("run");
  cx.begin(s->span);
  openRefillLoop(cx, run, "true", s->span);
  cx.out << "for (; " << run << " && --budget__.left >= 0; " << run << " = !(";
  emitValue(cx, s->until);
  cx.out << ")) {";
  cx.end();
  const Scoped<int64_t> counted(cx.modes.loops.uncounted, 1);
  emitLoopBody(cx, s->body, true);
}

// -------------------------------------------------------------------------------------------------
// FOR

/// A FOR loop whose variable has been found.
struct Counter {
  const ForStmt *stmt;
  const Type *type;     ///< of the variable, no subrange
  std::string number;   ///< of the names that belong to the loop
  std::string variable; ///< the C++ of it
  bool hasStep = false; ///< the step is a constant:
  int64_t step = 0;
  bool isShort = false;     ///< it ends soon, whatever happens
  bool countsAlone = false; ///< nothing else changes the variable
};

/// While the body is written the range of the variable may be known.
class KnownRange {
public:
  KnownRange(EmitContext &cx, const Counter &counter, int64_t uncounted = 1)
      : analysis_(cx.run.analysis), counted_(cx.modes.loops.uncounted, uncounted) {
    analysis_.enterLoop(counter.stmt, counter.countsAlone);
  }
  ~KnownRange() { analysis_.leaveLoop(); }
  KnownRange(const KnownRange &) = delete;
  KnownRange &operator=(const KnownRange &) = delete;

private:
  Analysis &analysis_;
  Scoped<int64_t> counted_;
};

/// The variable is found once, before the bounds are computed; and followed once where that takes a
/// call.
std::string findCounter(EmitContext &cx, const Expr *variable, const std::string &number) {
  std::string text = writableText(cx, variable);
  const bool shared = cx.isShared(variable);
  if (cx.run.analysis.placeEffects(variable, cx.pou) == kEffectNone && !shared &&
      locationOf(variable) == nullptr)
    return text;
  cx.out << (shared ? "const auto counter__" : "auto &counter__") << number << " = " << text
         << "; ";
  return "counter__" + number;
}

Counter counterOf(EmitContext &cx, const ForStmt *s) {
  Counter counter{s, underlying(s->variable->type), std::to_string(cx.number()), {}};
  cx.begin(s->span);
  counter.variable = findCounter(cx, s->variable, counter.number);
  counter.hasStep = s->by == nullptr || s->by->constant != nullptr;
  counter.step = s->by == nullptr ? 1 : counter.hasStep ? s->by->constant->integer : 0;
  // Within a loop that is not counted it would be another one.
  counter.isShort = cx.modes.loops.uncounted == 1 && cx.run.analysis.shortLoop(s);
  counter.countsAlone = !counter.isShort && cx.run.loopLocals.countsAlone(s, cx.pou);
  return counter;
}

/// `++i`, `i += 2`
void emitStep(EmitContext &cx, const Counter &counter) {
  const int64_t step = counter.step;
  if (step == 1 || step == -1)
    cx.out << (step > 0 ? "++" : "--") << counter.variable;
  else
    cx.out << counter.variable << (step > 0 ? " += " : " -= ") << (step > 0 ? step : -step);
}

/// `for (DINT at = 1; i = static_cast<INT>(at), at <= 10; ++at)`: a counter as wide as a register,
/// of which C++ knows that it does not wrap.
void openWide(EmitContext &cx, const Counter &counter) {
  const ForStmt *s = counter.stmt;
  const std::string at = "at__" + counter.number;
  const int64_t step = counter.step;
  cx.out << "for (::stride::DINT " << at << " = " << s->from->constant->integer << "; "
         << counter.variable << " = static_cast<" << cx.type(counter.type) << ">(" << at << "), "
         << at << (step > 0 ? " <= " : " >= ") << s->to->constant->integer << "; " << at
         << " += " << step << ") {";
  cx.end();
}

/// `for (i = 1; i <= 10; ++i)`
void openNarrow(EmitContext &cx, const Counter &counter) {
  const ForStmt *s = counter.stmt;
  cx.out << "for (";
  emitStoreTo(cx, counter.variable, s->variable->type, s->from);
  cx.out << ' ' << counter.variable << (counter.step > 0 ? " <= " : " >= ");
  emitValueAs(cx, s->to, counter.type);
  cx.out << "; ";
  emitStep(cx, counter);
  cx.out << ") {";
  cx.end();
}

/// Variables that each round sets anew, in a loop whose rounds have nothing else to do with each
/// other. Each round has its own, and all of them stay until the last one is taken: C++ need not
/// make the rounds one after the other.
class OwnSums {
public:
  OwnSums(EmitContext &cx, const Counter &counter) : cx_(cx), counter_(counter) {
    if (counter.step == 1)
      sums_ = innerSums(cx.run.analysis, counter.stmt, cx.modes.loops.locals);
    rounds_ = sums_.empty() ? 0 : cx.run.analysis.ownRounds(counter.stmt);
    for (const VarSymbol *v : sums_)
      cx.out << cx.type(v->type) << ' ' << all(v) << '[' << rounds_ << "]; ";
  }

  [[nodiscard]] bool empty() const { return sums_.empty(); }

  /// As emitLoopBody. EXIT and CONTINUE are not in it.
  void emitBody() {
    const int64_t from = counter_.stmt->from->constant->integer;
    cx_.open();
    for (const VarSymbol *v : sums_)
      cx_.line(std::string(cx_.type(v->type)) + ' ' + mangle(v->name.text) + ';');
    emitBlock(cx_, counter_.stmt->body);
    for (const VarSymbol *v : sums_)
      cx_.line(all(v) + '[' + counter_.variable + " - (" + std::to_string(from) +
               ")] = " + mangle(v->name.text) + ';');
    cx_.close();
    cx_.line("}");
    for (const VarSymbol *v : sums_)
      cx_.line(mangle(v->name.text) + " = " + all(v) + '[' + std::to_string(rounds_ - 1) + "];");
  }

private:
  /// `sum__rounds5`
  [[nodiscard]] std::string all(const VarSymbol *v) const {
    return mangle(v->name.text) + "__rounds" + counter_.number;
  }

  EmitContext &cx_;
  const Counter &counter_;
  std::vector<const VarSymbol *> sums_;
  int64_t rounds_ = 0;
};

/// A plain C++ loop, where that means the same: the body does not change the variable, and it does
/// not wrap after the end.
void emitCounted(EmitContext &cx, const Counter &counter) {
  const KnownRange range(cx, counter);
  OwnSums sums(cx, counter);
  if (bitWidth(counter.type) < 32)
    openWide(cx, counter);
  else
    openNarrow(cx, counter);
  if (sums.empty())
    emitLoopBody(cx, counter.stmt->body, false);
  else
    sums.emitBody();
}

/// All rounds are taken from the loop budget at once.
void takeRounds(EmitContext &cx, const ForStmt *s) {
  cx.uses.budget = true;
  cx.out << "budget__.refill((budget__.left -= " << cx.run.analysis.ownRounds(s) << ") < 0, "
         << cx.ctx() << ", ";
  cx.position(s->span);
  cx.out << "); ";
}

/// The end is evaluated once; gives what stands for it.
std::string takeEnd(EmitContext &cx, const Counter &counter) {
  const ForStmt *s = counter.stmt;
  std::string last = cx.text([&] { emitValueAs(cx, s->to, counter.type); });
  if (s->to->constant != nullptr)
    return last;
  cx.out << "const " << cx.type(counter.type) << " end__" << counter.number << " = " << last
         << "; ";
  return "end__" + counter.number;
}

/// Whether there is a first round.
std::string firstRound(EmitContext &cx, const Counter &counter, const std::string &last) {
  return counter.hasStep ? counter.variable + (counter.step >= 0 ? " <= " : " >= ") + last
                         : "::stride::forFirst<" + std::string(cx.type(counter.type)) + ">(" +
                               counter.variable + ", " + last + ", step__" + counter.number + ")";
}

/// `run = forUp<T>(i, last)`: to the next round, if there is one.
std::string nextRound(EmitContext &cx, const Counter &counter, const std::string &run,
                      const std::string &last) {
  const int64_t step = counter.step;
  const auto size = static_cast<uint64_t>(step);
  std::string out = run + " = ::stride::" +
                    (!counter.hasStep ? "forNext<"
                     : step >= 0      ? "forUp<"
                                      : "forDown<") +
                    std::string(cx.type(counter.type)) + ">(" + counter.variable + ", " + last;
  if (!counter.hasStep)
    out += ", step__" + counter.number;
  else if (step != 1 && step != -1)
    out += ", " + std::to_string(step >= 0 ? size : 0 - size) + "U";
  return out + ")";
}

/// Any FOR loop.
void emitGeneral(EmitContext &cx, const Counter &counter) {
  const ForStmt *s = counter.stmt;
  emitStoreTo(cx, counter.variable, s->variable->type, s->from);
  cx.out << ' ';
  const std::string last = takeEnd(cx, counter);
  if (!counter.hasStep) {
    cx.out << "const ::stride::LINT step__" << counter.number << " = ";
    emitValue(cx, s->by);
    cx.out << "; ";
  }
  const std::string run = "run__" + counter.number;
  const std::string first = firstRound(cx, counter, last);
  const std::string next = nextRound(cx, counter, run, last);
  if (counter.isShort) {
    cx.out << "for (bool " << run << " = " << first << "; " << run << "; " << next << ") {";
  } else {
    openRefillLoop(cx, run, first, s->span);
    cx.out << "for (; budget__.left > 0 && " << run << "; --budget__.left, " << next << ") {";
  }
  cx.end();
  const KnownRange range(cx, counter);
  emitLoopBody(cx, s->body, !counter.isShort);
}

/// So many rounds do the loop and those around it make at most, within one that is not counted and
/// so only computes; 1: this one has to be counted.
int64_t uncountedRounds(const EmitContext &cx, const ForStmt *s) {
  const int64_t around = cx.modes.loops.uncounted;
  const int64_t own = around == 1 ? 0 : cx.run.analysis.roundsAtMost(s);
  return own > 0 && own <= Analysis::kShortLoop / around ? own * around : 1;
}

/// Bounds that are known at run time, of a variable with so few bits that the loop is short
/// whatever they are: all rounds are taken from the loop budget at once.
void emitFewBits(EmitContext &cx, const Counter &counter) {
  const ForStmt *s = counter.stmt;
  const bool up = counter.step > 0;
  const std::string at = "at__" + counter.number;
  const std::string stop = "stop__" + counter.number;
  emitStoreTo(cx, counter.variable, s->variable->type, s->from);
  cx.out << " const ::stride::DINT " << stop << " = ";
  emitValueAs(cx, s->to, counter.type);
  cx.out << (up ? " + 1" : " - 1") << "; ::stride::DINT " << at << " = " << counter.variable
         << "; ";
  const int64_t uncounted = uncountedRounds(cx, s);
  if (uncounted == 1) {
    cx.uses.budget = true;
    cx.out << "budget__.refill((budget__.left -= ::stride::roundsTo(" << at << ", " << stop << ", "
           << counter.step << ")) < 0, " << cx.ctx() << ", ";
    cx.position(s->span);
    cx.out << "); ";
  }
  cx.out << "for (; " << counter.variable << " = static_cast<" << cx.type(counter.type) << ">("
         << at << "), " << at << (up ? " < " : " > ") << stop << "; " << at
         << " += " << counter.step << ") {";
  cx.end();
  const KnownRange range(cx, counter, uncounted);
  emitLoopBody(cx, s->body, false);
}

/// Neither the rounds are too many nor a sum of the variable and the step for a DINT.
bool endsSoon(const EmitContext &cx, const Counter &counter) {
  constexpr int64_t kMost = 1 << 16;
  if (!counter.hasStep || counter.step == 0 || counter.step < -kMost || counter.step > kMost)
    return false;
  const unsigned bits = bitWidth(counter.type);
  return bits < 32 ||
         (bits == 32 && cx.run.analysis.roundsAtMost(counter.stmt) <= Analysis::kShortLoop);
}

void emitFor(EmitContext &cx, const ForStmt *s) {
  const Analysis &analysis = cx.run.analysis;
  const Counter counter = counterOf(cx, s);
  // Rounds that are taken from the budget and not made would count as made.
  const bool isWhole = counter.countsAlone && !mayLeave(s->body, true);
  const bool atOnce = isWhole && analysis.fewRounds(s);
  const bool counted = (counter.isShort || atOnce) && analysis.endsInside(s);
  if (counted && !counter.isShort)
    takeRounds(cx, s);
  if (counted)
    emitCounted(cx, counter);
  else if (isWhole && endsSoon(cx, counter))
    emitFewBits(cx, counter);
  else
    emitGeneral(cx, counter);
}

void emitPlainLoop(EmitContext &cx, const Stmt *s) {
  if (s->kind == StmtKind::For)
    emitFor(cx, as<ForStmt>(s));
  else if (s->kind == StmtKind::While)
    emitWhile(cx, as<WhileStmt>(s));
  else
    emitRepeat(cx, as<RepeatStmt>(s));
}

/// `{ T x = this->x; const LoopContext loop{…};`: gives the name of what stands for the context.
std::string openLocals(EmitContext &cx, Span span) {
  cx.begin(span);
  cx.out << '{';
  std::string back;
  for (const VarSymbol *v : cx.modes.loops.locals) {
    const std::string name = mangle(v->name.text);
    cx.out << ' ' << cx.type(v->type) << ' ' << name << " = this->" << name << ';';
    // Neighbouring reals would be gathered in vectors, whose loads wait for the stores of halves.
    back += " this->" + name + " = " +
            (isReal(underlying(v->type)) ? "::stride::single(" + name + ")" : name) + ";";
  }
  std::string context = cx.temporary("loop");
  cx.out << " const ::stride::LoopContext " << context << '{' << cx.ctx()
         << ", [&]() __attribute__((always_inline)) {" << back << " }};";
  cx.end();
  return context;
}

void emitWithLocals(EmitContext &cx, const Stmt *s) {
  Loops &loops = cx.modes.loops;
  std::vector<const VarSymbol *> locals;
  if (loops.locals.empty()) // the outermost one
    locals = cx.run.loopLocals.of(s, cx.pou);
  if (locals.empty()) {
    emitPlainLoop(cx, s);
    return;
  }
  const Scoped<std::vector<const VarSymbol *>> kept(loops.locals, std::move(locals));
  const std::string context = openLocals(cx, s->span);
  cx.open();
  {
    const Scoped<std::string> own(loops.context, context);
    emitPlainLoop(cx, s);
  }
  cx.line(context + ".save();");
  cx.close();
  cx.line("}");
}

} // namespace

// The cycle's time is the same all the time, but C++ does not know which stores leave the context
// alone. What it computes from a copy that nobody else has is computed before the loop.
void emitLoop(EmitContext &cx, const Stmt *s) {
  Loops &loops = cx.modes.loops;
  if (loops.plain != kContext || !cx.run.plainCalls.readsClock(s)) {
    emitWithLocals(cx, s);
    return;
  }
  const Scoped<std::string> copy(loops.plain, cx.temporary("clock"));
  cx.begin(s->span);
  cx.out << "{ ::stride::Ctx " << loops.plain << " = " << kContext << ';';
  cx.uses.context = true;
  cx.end();
  cx.open();
  emitWithLocals(cx, s);
  cx.close();
  cx.line("}");
}

} // namespace stc::codegen
