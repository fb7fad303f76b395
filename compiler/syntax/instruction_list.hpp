#ifndef STRIDE_COMPILER_SYNTAX_INSTRUCTION_LIST_HPP
#define STRIDE_COMPILER_SYNTAX_INSTRUCTION_LIST_HPP
// Instruction List, the line-oriented language of IEC 61131-3: its operators, and how a body of
// instructions becomes the statements of Structured Text. Internal to compiler/syntax, but for
// isInstructionList().

#include "compiler/source/arena.hpp"
#include "compiler/source/diagnostic.hpp"
#include "compiler/source/identifier.hpp"
#include "compiler/syntax/ast.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace stc {

/// What an operator of an instruction list does with the current result.
enum class Operation : uint8_t { Load, Store, Set, Reset, Calculate, Not, Jump, Call, Return };

/// One operator, with its modifiers.
struct InstructionOperator {
  std::string_view lower;
  Operation operation = Operation::Load;
  ast::BinaryOp binary = ast::BinaryOp::Add; ///< of Calculate
  bool negated = false;                      ///< N: of the operand, or of the condition
  bool conditional = false;                  ///< C: only while the current result is TRUE
  unsigned least = 1;                        ///< operands
  unsigned most = 1;
};

/// Null: the word (in any case of letters) is no operator.
[[nodiscard]] const InstructionOperator *findInstruction(std::string_view word);

/// Whether the text of a body is an instruction list: its first instruction, after a label or not,
/// is no statement of Structured Text. So the parser decides it, too; pragmas must not precede it.
[[nodiscard]] bool isInstructionList(std::string_view body);

/// True for an operator with a modifier that it does not have (`LDC`).
[[nodiscard]] bool hasWrongModifier(std::string_view word);

/// One line.
struct Instruction {
  enum class Kind : uint8_t {
    Label,    ///< `name:`
    Operator, ///< `op`
    Function, ///< `SEL a, b`: the current result is the first argument
    Value,    ///< `LIMIT(MN := 0, IN := x, MX := 9)`: a call that does not use the current result
    Close,    ///< `)`
  };
  Kind kind = Kind::Operator;
  const InstructionOperator *op = nullptr;
  bool opens = false; ///< `AND(`: the right side follows, up to `)`
  Span span;
  Span opSpan;
  ast::Name label;             ///< of a label; where JMP leads
  ast::Expr *callee = nullptr; ///< of Function
  std::vector<ast::Expr *> operands;
};

/// Turns instructions into statements. The current result stays an expression until it is used, so
/// that types, conversions and messages are those of Structured Text. Where it is used again, or
/// lives across a jump, a label or a call, it goes into a variable of the body whose type is that
/// of its first value.
class InstructionLowering {
public:
  /// `variables` of the body get those that the current result needs; `prefix` begins their names.
  InstructionLowering(const std::vector<Instruction> &list, Interner &interner, Arena &arena,
                      Diagnostics &diagnostics, std::vector<ast::VarDecl *> &variables,
                      std::string prefix = "cr__");
  void run(std::vector<ast::Stmt *> &out);

private:
  /// The current result; without expression and variable it is undefined.
  struct Result {
    ast::Expr *expr = nullptr;
    ast::VarDecl *variable = nullptr; ///< holds it; then `expr` is the value's place in the text
    unsigned depth = 0;               ///< operators in `expr`
    [[nodiscard]] bool isDefined() const { return expr != nullptr; }
  };
  /// `AND(` that waits for its `)`.
  struct Open {
    Result left;
    const Instruction *instruction;
  };

  [[nodiscard]] bool isUsedFrom(size_t at) const;
  [[nodiscard]] bool labelUses(const ast::Name &label) const;
  void instruction(size_t at);
  void operate(const Instruction &one, size_t at);
  void load(const Instruction &one);
  void calculate(const Instruction &one);
  void close(const Instruction &one);
  void store(const Instruction &one, size_t at);
  void jump(const Instruction &one, size_t at);
  void label(const Instruction &one, size_t at);
  void call(const Instruction &one, size_t at);
  void leave(const Instruction &one, size_t at);
  void function(const Instruction &one);

  /// The current result for `one`; says so when it is undefined.
  ast::Expr *current(const Instruction &one);
  /// The same for an instruction that leaves it as it is: `isUsedLater` keeps it in a variable.
  ast::Expr *peek(const Instruction &one, bool isUsedLater);
  void reportUndefined(Span where, const char *why);
  void set(ast::Expr *expr, unsigned depth);
  void combine(const Instruction &one, const InstructionOperator &op, ast::Expr *right, Span whole);
  /// Forgets the current result, but not the calls in it.
  void drop();
  void keep(Result &result);
  [[nodiscard]] ast::Expr *read(const Result &result);
  [[nodiscard]] ast::Expr *negation(const Instruction &one, ast::Expr *expr);
  ast::VarDecl *variable(Span span);
  ast::Expr *nameOf(const ast::VarDecl *variable, Span span);
  void assign(ast::Expr *target, ast::Expr *value, const Instruction &one, ast::AssignOp op);
  void assignTo(const ast::VarDecl *variable, ast::Expr *value);
  void emit(ast::Stmt *stmt);
  void emitIf(const Instruction &one, ast::Expr *condition, ast::Stmt *stmt);

  const std::vector<Instruction> &list_;
  Interner &interner_;
  Arena &arena_;
  Diagnostics &diagnostics_;
  std::vector<ast::VarDecl *> &variables_;
  std::vector<ast::Stmt *> *out_ = nullptr;
  std::unordered_map<Ident, size_t> labels_;
  std::unordered_map<Ident, ast::VarDecl *> merged_; ///< the current result at a label
  Result now_;
  std::vector<Open> open_;
  bool reachable_ = true;
  std::string prefix_;
  unsigned made_ = 0;
};

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_INSTRUCTION_LIST_HPP
