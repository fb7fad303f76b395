// The operators of Instruction List.
#include "compiler/syntax/instruction_list.hpp"

#include "compiler/syntax/token.hpp"

#include <algorithm>
#include <limits>

namespace stc {

using ast::BinaryOp;

namespace {

constexpr unsigned kMany = std::numeric_limits<unsigned>::max();

constexpr InstructionOperator row(std::string_view lower, Operation operation, bool negated = false,
                                  bool conditional = false, unsigned operands = 1) {
  return {lower, operation, BinaryOp::Add, negated, conditional, operands, operands};
}

constexpr InstructionOperator math(std::string_view lower, BinaryOp op, unsigned most = 1,
                                   bool negated = false) {
  return {lower, Operation::Calculate, op, negated, false, 1, most};
}

constexpr InstructionOperator kOperators[] = {
    row("ld", Operation::Load),
    row("ldn", Operation::Load, true),
    row("st", Operation::Store),
    row("stn", Operation::Store, true),
    row("s", Operation::Set),
    row("r", Operation::Reset),
    row("not", Operation::Not, false, false, 0),
    row("jmp", Operation::Jump),
    row("jmpc", Operation::Jump, false, true),
    row("jmpcn", Operation::Jump, true, true),
    row("cal", Operation::Call),
    row("calc", Operation::Call, false, true),
    row("calcn", Operation::Call, true, true),
    row("ret", Operation::Return, false, false, 0),
    row("retc", Operation::Return, false, true, 0),
    row("retcn", Operation::Return, true, true, 0),
    math("and", BinaryOp::LogicalAnd, kMany),
    math("andn", BinaryOp::LogicalAnd, 1, true),
    math("&", BinaryOp::LogicalAnd, kMany),
    math("&n", BinaryOp::LogicalAnd, 1, true),
    math("or", BinaryOp::LogicalOr, kMany),
    math("orn", BinaryOp::LogicalOr, 1, true),
    math("xor", BinaryOp::LogicalXor, kMany),
    math("xorn", BinaryOp::LogicalXor, 1, true),
    math("add", BinaryOp::Add, kMany),
    math("sub", BinaryOp::Subtract),
    math("mul", BinaryOp::Multiply, kMany),
    math("div", BinaryOp::Divide),
    math("mod", BinaryOp::Modulo),
    math("gt", BinaryOp::Greater),
    math("ge", BinaryOp::GreaterEqual),
    math("eq", BinaryOp::Equal),
    math("ne", BinaryOp::NotEqual),
    math("le", BinaryOp::LessEqual),
    math("lt", BinaryOp::Less),
};

/// Not every word that is made so: LEN and GEN are names of functions.
constexpr std::string_view kWrong[] = {
    "ldc", "ldcn", "stc", "stcn", "sn",   "sc",   "rn",   "rc",   "addn", "subn", "muln", "divn",
    "gtn", "eqn",  "nen", "ltn",  "jmpn", "caln", "retn", "andc", "orc",  "xorc", "notn", "modn"};

} // namespace

const InstructionOperator *findInstruction(std::string_view word) {
  const auto *const found =
      std::find_if(std::begin(kOperators), std::end(kOperators),
                   [&](const InstructionOperator &one) { return isWord(word, one.lower); });
  return found == std::end(kOperators) ? nullptr : found;
}

bool hasWrongModifier(std::string_view word) {
  return std::any_of(std::begin(kWrong), std::end(kWrong),
                     [&](std::string_view one) { return isWord(word, one); });
}

} // namespace stc
