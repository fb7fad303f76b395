// The table of built-in functions: names, formal names, numbers of arguments.
#include "compiler/semantics/builtins.hpp"
#include "compiler/source/identifier.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace stc {
namespace {

using ast::Builtin;
using ::testing::Eq;
using ::testing::Optional;

TEST(Builtins, EachNameOnce) {
  Interner interner;
  std::set<Ident> seen;
  for (const BuiltinName &one : builtinNames()) {
    EXPECT_FALSE(one.name.empty());
    EXPECT_TRUE(seen.insert(interner.intern(one.name)).second) << one.name << " stands twice";
    EXPECT_TRUE(
        std::none_of(one.name.begin(), one.name.end(), [](char c) { return c >= 'a' && c <= 'z'; }))
        << one.name << " is not in capitals";
  }
  EXPECT_EQ(seen.size(), builtinNames().size());
}

TEST(Builtins, NoNameIsThatOfAConversion) {
  Interner interner;
  for (const BuiltinName &one : builtinNames())
    EXPECT_FALSE(findConversion(interner.intern(one.name))) << one.name;
}

TEST(Builtins, RowsAreFoundByEveryName) {
  const auto row = [](std::string_view name) -> std::string_view {
    for (const BuiltinName &one : builtinNames())
      if (one.name == name)
        return builtinRow(one.function).name;
    return {};
  };
  EXPECT_EQ(row("ABS"), "ABS"); // the first
  EXPECT_EQ(row("LIMIT"), "LIMIT");
  EXPECT_EQ(row("FAIL"), "FAIL"); // the last
  EXPECT_EQ(row("WMID"), "MID");
  EXPECT_EQ(row("REF"), "ADR");
  EXPECT_EQ(row("XSIZEOF"), "SIZEOF");
  EXPECT_EQ(row("MULTIME"), "MUL_TIME");
  EXPECT_EQ(builtinRow(Builtin::Convert).name, "");
}

TEST(Builtins, FormalNamesHavePositions) {
  EXPECT_THAT(formalPosition(Builtin::Limit, "mn"), Optional(Eq(0U)));
  EXPECT_THAT(formalPosition(Builtin::Limit, "in"), Optional(Eq(1U)));
  EXPECT_THAT(formalPosition(Builtin::Limit, "mx"), Optional(Eq(2U)));
  EXPECT_EQ(formalPosition(Builtin::Limit, "in1"), std::nullopt);
  EXPECT_THAT(formalPosition(Builtin::Mux, "k"), Optional(Eq(0U)));
  EXPECT_THAT(formalPosition(Builtin::Mux, "in0"), Optional(Eq(1U)));
  EXPECT_THAT(formalPosition(Builtin::Mux, "in63"), Optional(Eq(64U)));
  EXPECT_EQ(formalPosition(Builtin::Mux, "in64"), std::nullopt);
  EXPECT_THAT(formalPosition(Builtin::Min, "in1"), Optional(Eq(0U)));
  EXPECT_EQ(formalPosition(Builtin::Min, "in0"), std::nullopt);
  EXPECT_EQ(formalPosition(Builtin::Min, "in1x"), std::nullopt);
  EXPECT_THAT(formalPosition(Builtin::Concat, "str2"), Optional(Eq(1U)));
  EXPECT_THAT(formalPosition(Builtin::Mid, "p"), Optional(Eq(2U)));
  EXPECT_THAT(formalPosition(Builtin::Mid, "pos"), Optional(Eq(2U)));
  EXPECT_EQ(formalPosition(Builtin::Time, "in"), std::nullopt);
}

TEST(Builtins, AssertionsHaveTheirMessageLast) {
  EXPECT_EQ(assertedValues(Builtin::FailTest), 0U);
  EXPECT_EQ(assertedValues(Builtin::AssertTrue), 1U);
  EXPECT_EQ(assertedValues(Builtin::AssertLe), 2U);
  EXPECT_EQ(assertedValues(Builtin::AssertNear), 3U);
  EXPECT_THAT(formalPosition(Builtin::AssertNear, "message"), Optional(Eq(3U)));
}

/// What a call may do decides whether its result may be unused, and what code generation may move.
TEST(Builtins, OnlyComputeOrDoMore) {
  const auto computes = [](Builtin function) { return builtinRow(function).onlyComputes(); };
  for (const Builtin function : {Builtin::Abs, Builtin::Mux, Builtin::Greater, Builtin::Find,
                                 Builtin::Convert, Builtin::Time, Builtin::ToBcd})
    EXPECT_TRUE(computes(function)) << static_cast<int>(function);
  for (const Builtin function :
       {Builtin::Adr, Builtin::Sizeof, Builtin::Ini, Builtin::NewObject, Builtin::DeleteObject,
        Builtin::QueryPointer, Builtin::AssertTrue, Builtin::LowerBound, Builtin::Bitadr})
    EXPECT_FALSE(computes(function)) << static_cast<int>(function);
}

} // namespace
} // namespace stc
