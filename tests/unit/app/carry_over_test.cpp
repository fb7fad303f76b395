// Online change on descriptions made by hand: each rule by itself.
#include "carry_fixture.hpp"

#include <limits>

namespace stride::test {
size_t allocations();
}

namespace {

using namespace stride;
using namespace stride::app;
using stride::test::AppModel;
using stride::test::CarryOverTest;
using stride::test::ModelField;
using stride::test::ModelType;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(CarryOverTest, RootsByListAndNameInAnyOrder) {
  a.root("G", "x", a.elementary(Kind::INT));
  a.root("H", "x", a.elementary(Kind::INT));
  a.root("", "gone", a.elementary(Kind::LREAL));
  b.root("", "fresh", b.elementary(Kind::DINT));
  b.root("H", "X", b.elementary(Kind::INT));
  b.root("g", "x", b.elementary(Kind::INT));
  a.ready();
  b.ready();
  a.set<int16_t>(a.at(0), 1);
  a.set<int16_t>(a.at(1), 2);
  b.set<int32_t>(b.at(0), 77);
  EXPECT_EQ(apply(), "2 values are carried over, none is lost\n"
                     "  added: fresh : DINT\n"
                     "  dropped: gone : LREAL\n");
  EXPECT_EQ(b.get<int32_t>(b.at(0)), 77);
  EXPECT_EQ(b.get<int16_t>(b.at(1)), 2);
  EXPECT_EQ(b.get<int16_t>(b.at(2)), 1);
}

TEST_F(CarryOverTest, NumbersOnlyWhereEveryValueSurvives) {
  const std::vector<std::pair<Kind, Kind>> kept = {
      {Kind::SINT, Kind::LINT},  {Kind::BYTE, Kind::INT},   {Kind::USINT, Kind::BYTE},
      {Kind::UINT, Kind::DINT},  {Kind::INT, Kind::REAL},   {Kind::DINT, Kind::LREAL},
      {Kind::REAL, Kind::LREAL}, {Kind::TIME, Kind::LTIME}, {Kind::DT, Kind::LDT},
      {Kind::DATE, Kind::LDATE}, {Kind::TOD, Kind::LTOD},   {Kind::DWORD, Kind::UDINT}};
  const std::vector<std::pair<Kind, Kind>> lost = {
      {Kind::INT, Kind::SINT},   {Kind::INT, Kind::UINT},   {Kind::BYTE, Kind::SINT},
      {Kind::DINT, Kind::REAL},  {Kind::LINT, Kind::LREAL}, {Kind::LREAL, Kind::REAL},
      {Kind::REAL, Kind::LINT},  {Kind::BOOL, Kind::INT},   {Kind::INT, Kind::BOOL},
      {Kind::TIME, Kind::UDINT}, {Kind::LTIME, Kind::TIME}, {Kind::DT, Kind::LDATE}};
  for (const auto &[from, to] : kept)
    EXPECT_TRUE(keepsEveryValue(from, to)) << AppModel::kindName(from) << AppModel::kindName(to);
  for (const auto &[from, to] : lost)
    EXPECT_FALSE(keepsEveryValue(from, to)) << AppModel::kindName(from) << AppModel::kindName(to);
  for (const auto &list : {kept, lost}) {
    for (const auto &[from, to] : list) {
      const std::string name = "v" + std::to_string(a.roots.size());
      a.root("", name, a.elementary(from));
      b.root("", name, b.elementary(to));
    }
  }
  a.ready();
  b.ready();
  a.set<int8_t>(a.at(0), -5);
  a.set<uint8_t>(a.at(1), 250);
  a.set<uint8_t>(a.at(2), 251);
  a.set<uint16_t>(a.at(3), 65000);
  a.set<int16_t>(a.at(4), -32000);
  a.set<int32_t>(a.at(5), std::numeric_limits<int32_t>::min());
  a.set<float>(a.at(6), 0.1F);
  a.set<uint32_t>(a.at(7), 4294967295U);
  a.set<uint32_t>(a.at(8), 4000000000U);
  a.set<uint32_t>(a.at(9), 86400U);
  a.set<uint32_t>(a.at(10), 1500U);
  a.set<uint32_t>(a.at(11), 0xDEADBEEFU);
  for (size_t i = kept.size(); i < b.roots.size(); ++i)
    std::memset(b.state() + b.at(i), 0x5A, b.roots[i].type->size);
  apply();
  EXPECT_EQ(b.get<int64_t>(b.at(0)), -5);
  EXPECT_EQ(b.get<int16_t>(b.at(1)), 250);
  EXPECT_EQ(b.get<uint8_t>(b.at(2)), 251);
  EXPECT_EQ(b.get<int32_t>(b.at(3)), 65000);
  EXPECT_EQ(b.get<float>(b.at(4)), -32000.0F);
  EXPECT_EQ(b.get<double>(b.at(5)), -2147483648.0);
  EXPECT_EQ(b.get<double>(b.at(6)), static_cast<double>(0.1F));
  EXPECT_EQ(b.get<int64_t>(b.at(7)), 4294967295'000000);
  EXPECT_EQ(b.get<int64_t>(b.at(8)), 4000000000'000000000);
  EXPECT_EQ(b.get<int64_t>(b.at(9)), 86400'000000000);
  EXPECT_EQ(b.get<int64_t>(b.at(10)), 1500'000000);
  EXPECT_EQ(b.get<uint32_t>(b.at(11)), 0xDEADBEEFU);
  for (size_t i = kept.size(); i < b.roots.size(); ++i)
    EXPECT_EQ(b.get<uint8_t>(b.at(i)), 0x5A) << i;
}

TEST_F(CarryOverTest, Renamed) {
  const auto type = [](AppModel &m, std::vector<ModelField> fields) {
    return m.structure("S", std::move(fields));
  };
  const ModelType *i = a.elementary(Kind::INT);
  const ModelType *j = b.elementary(Kind::INT);
  a.root("", "s", type(a, {{"x", i}, {"y", i}, {"z", i}}));
  // y takes x's name, x takes y's: both at once; z keeps an attribute of an earlier change
  b.root("", "s", type(b, {{"x", j, 0, "y"}, {"y", j, 0, "x"}, {"z", j, 0, "w"}}));
  a.root("G", "old", i);
  b.root("G", "new", j, 0, "old");
  a.root("G", "moved", i);
  b.root("H", "moved", j, 0, "g.MOVED");
  // the name is used again for something else
  a.root("", "n", i);
  b.root("", "n", j);
  b.root("", "m", j, 0, "n");
  a.ready();
  b.ready();
  for (uint64_t k = 0; k < 3; ++k)
    a.set<int16_t>(a.at(0) + 2 * k, static_cast<int16_t>(k + 1));
  a.set<int16_t>(a.at(1), 4);
  a.set<int16_t>(a.at(2), 5);
  a.set<int16_t>(a.at(3), 6);
  const std::string text = apply();
  EXPECT_EQ(b.get<int16_t>(b.at(0)), 2);
  EXPECT_EQ(b.get<int16_t>(b.at(0) + 2), 1);
  EXPECT_EQ(b.get<int16_t>(b.at(0) + 4), 3);
  EXPECT_EQ(b.get<int16_t>(b.at(1)), 4);
  EXPECT_EQ(b.get<int16_t>(b.at(2)), 5);
  EXPECT_EQ(b.get<int16_t>(b.at(3)), 0);
  EXPECT_EQ(b.get<int16_t>(b.at(4)), 6);
  EXPECT_THAT(text, HasSubstr("renamed: s.x : INT (was s.y)"));
  EXPECT_THAT(text, HasSubstr("renamed: H.moved : INT (was G.moved)"));
  EXPECT_THAT(text, HasSubstr("added: n : INT"));
}

TEST_F(CarryOverTest, RenamedOnceOnly) {
  // The attribute is still there at the next change: the new name counts now, even if the old name
  // is in use again.
  const ModelType *i = a.elementary(Kind::INT);
  const ModelType *j = b.elementary(Kind::INT);
  a.root("", "m", i, 0, "n");
  a.root("", "n", i);
  b.root("", "m", j, 0, "n");
  b.root("", "n", j);
  a.ready();
  b.ready();
  a.set<int16_t>(a.at(0), 1);
  a.set<int16_t>(a.at(1), 2);
  apply();
  EXPECT_EQ(b.get<int16_t>(b.at(0)), 1);
  EXPECT_EQ(b.get<int16_t>(b.at(1)), 2);
}

TEST_F(CarryOverTest, ConstantsTypeIdsAndResetVariablesAreTheNewOnes) {
  const auto block = [](AppModel &m) {
    return m.structure("B",
                       {{"type__", m.elementary(Kind::UDINT), kSymTypeId | kSymHidden},
                        {"k", m.elementary(Kind::INT), kSymConstant},
                        {"x", m.elementary(Kind::INT)},
                        {"r", m.elementary(Kind::INT), kSymInitOnChange},
                        {"y", m.elementary(Kind::INT)}},
                       nullptr, Kind::FunctionBlock);
  };
  a.root("", "fbs", a.array(block(a), 1, 3));
  b.root("", "fbs", b.array(block(b), 1, 3));
  a.root("", "k", a.elementary(Kind::INT), kSymConstant);
  b.root("", "k", b.elementary(Kind::INT), kSymConstant);
  a.ready();
  b.ready();
  std::memset(a.state(), 0x11, a.app().stateSize);
  std::memset(b.state(), 0x22, b.app().stateSize);
  EXPECT_THAT(apply(), HasSubstr("reset: fbs[1].r : INT ({attribute 'init_on_onlchange'}) in 3"));
  for (uint64_t e = 0; e < 3; ++e) {
    EXPECT_EQ(b.get<uint32_t>(12 * e), 0x22222222U);
    EXPECT_EQ(b.get<int16_t>(12 * e + 4), 0x2222);
    EXPECT_EQ(b.get<int16_t>(12 * e + 6), 0x1111);
    EXPECT_EQ(b.get<int16_t>(12 * e + 8), 0x2222);
    EXPECT_EQ(b.get<int16_t>(12 * e + 10), 0x1111);
  }
  EXPECT_EQ(b.get<int16_t>(b.at(1)), 0x2222);
}

TEST_F(CarryOverTest, PaddingOfTheOldIsNoNewField) {
  const auto *s1 =
      a.structure("S", {{"x", a.elementary(Kind::BOOL)}, {"y", a.elementary(Kind::INT)}});
  const auto *s2 = b.structure("S", {{"x", b.elementary(Kind::BOOL)},
                                     {"z", b.elementary(Kind::BOOL)},
                                     {"y", b.elementary(Kind::INT)}});
  a.root("", "s", s1);
  b.root("", "s", s2);
  a.root("", "c", a.elementary(Kind::BOOL));
  b.root("", "c", b.elementary(Kind::BOOL));
  b.root("", "d", b.elementary(Kind::BOOL));
  a.root("", "e", a.elementary(Kind::INT));
  b.root("", "e", b.elementary(Kind::INT));
  a.ready();
  b.ready();
  std::memset(a.state(), 0x11, a.app().stateSize);
  b.set<uint8_t>(1, 7);
  b.set<uint8_t>(b.at(2), 8);
  apply();
  EXPECT_EQ(b.get<uint8_t>(0), 0x11);
  EXPECT_EQ(b.get<uint8_t>(1), 7);
  EXPECT_EQ(b.get<int16_t>(2), 0x1111);
  EXPECT_EQ(b.get<uint8_t>(b.at(2)), 8);
  EXPECT_EQ(b.get<int16_t>(b.at(3)), 0x1111);
}

TEST_F(CarryOverTest, ArraysByIndex) {
  const auto *i = a.elementary(Kind::DINT);
  const auto *j = b.elementary(Kind::DINT);
  a.root("", "m", a.array(a.array(i, -1, 1), 1, 3));
  b.root("", "m", b.array(b.array(j, 0, 2), 2, 5));
  a.root("", "apart", a.array(i, 1, 3));
  b.root("", "apart", b.array(j, 7, 9));
  a.ready();
  b.ready();
  for (int32_t k = 0; k < 9; ++k)
    a.set<int32_t>(4 * static_cast<uint64_t>(k), 10 * (k / 3 + 1) + k % 3 - 1);
  for (uint64_t k = 0; k < 15; ++k)
    b.set<int32_t>(4 * k, -7);
  EXPECT_EQ(
      apply(),
      "4 values are carried over, some are lost\n"
      "  elements lost: m : ARRAY[1..3] OF ARRAY[-1..1] OF DINT -> ARRAY[2..5] OF ARRAY[0..2] "
      "OF DINT (2 of 3 elements are kept)\n"
      "  elements lost: m[2] : ARRAY[-1..1] OF DINT -> ARRAY[0..2] OF DINT (2 of 3 elements "
      "are kept) in 2 places\n"
      "  lost: apart : ARRAY[1..3] OF DINT -> ARRAY[7..9] OF DINT\n");
  const std::vector<int32_t> expected = {20, 21, -7, 30, 31, -7, -7, -7, -7, -7, -7, -7};
  for (uint64_t k = 0; k < 12; ++k)
    EXPECT_EQ(b.get<int32_t>(4 * k), expected[k]) << k;
  EXPECT_EQ(b.get<int32_t>(b.at(1)), -7);
}

TEST_F(CarryOverTest, Texts) {
  a.root("", "longer", a.string(4));
  b.root("", "longer", b.string(9));
  a.root("", "cut", a.string(9));
  b.root("", "cut", b.string(4));
  a.root("", "fits", a.string(9));
  b.root("", "fits", b.string(4));
  a.root("", "wide", a.string(5, true));
  b.root("", "wide", b.string(3, true));
  a.root("", "other", a.string(5));
  b.root("", "other", b.string(5, true));
  a.ready();
  b.ready();
  std::memset(b.state(), 'x', b.app().stateSize);
  std::memcpy(a.state() + a.at(0), "abcd", 5);
  std::memcpy(a.state() + a.at(1), "abcdefghi", 10);
  std::memcpy(a.state() + a.at(2), "abcd\0fghi", 10);
  std::memcpy(a.state() + a.at(3), u"abcde", 12);
  std::memcpy(a.state() + a.at(4), "abc", 4);
  const std::string text = apply();
  EXPECT_STREQ(reinterpret_cast<char *>(b.state() + b.at(0)), "abcd");
  EXPECT_STREQ(reinterpret_cast<char *>(b.state() + b.at(1)), "abcd");
  EXPECT_STREQ(reinterpret_cast<char *>(b.state() + b.at(2)), "abcd");
  EXPECT_EQ(std::memcmp(b.state() + b.at(3), u"abc", 8), 0);
  EXPECT_EQ(b.get<char>(b.at(4)), 'x');
  EXPECT_THAT(words, ElementsAre("cut: its text was cut to 4 characters",
                                 "wide: its text was cut to 3 characters"));
  EXPECT_THAT(text, HasSubstr("converted: longer"));
  EXPECT_THAT(text, HasSubstr("may be cut: fits"));
  EXPECT_THAT(text, HasSubstr("lost: other"));
}

TEST_F(CarryOverTest, EnumerationsByName) {
  a.root("", "e", a.array(a.enumeration("E", {{"off", 0}, {"on", 1}, {"err", 2}, {"x", 3}}), 0, 5));
  b.root("", "e",
         b.array(b.enumeration("E", {{"off", 0}, {"wait", 1}, {"on", 2}, {"y", 3}}), 0, 5));
  // as before: the bytes are copied
  a.root("", "f", a.enumeration("F", {{"p", 0}, {"q", 1}}));
  b.root("", "f", b.enumeration("F", {{"p", 0}, {"q", 1}, {"r", 2}}));
  // another base type
  a.root("", "g", a.enumeration("G", {{"p", 0}, {"q", 200}}, Kind::USINT));
  b.root("", "g", b.enumeration("G", {{"p", 0}, {"q", 200}}, Kind::DINT));
  // as a number
  a.root("", "h", a.enumeration("F2", {{"p", 0}, {"q", -1}}));
  b.root("", "h", b.elementary(Kind::DINT));
  // a number does not become an enumerator
  a.root("", "n", a.elementary(Kind::INT));
  b.root("", "n", b.enumeration("N", {{"p", 0}, {"q", 1}}));
  a.ready();
  b.ready();
  const int16_t values[] = {0, 1, 2, 3, 17, -1};
  for (uint64_t k = 0; k < 6; ++k) {
    a.set<int16_t>(2 * k, values[k]);
    b.set<int16_t>(2 * k, 99);
  }
  a.set<int16_t>(a.at(1), 1);
  a.set<uint8_t>(a.at(2), 200);
  a.set<int16_t>(a.at(3), -1);
  a.set<int16_t>(a.at(4), 1);
  const std::string text = apply();
  // err was removed: 2 is another one's number now. x became y.
  const int16_t expected[] = {0, 2, 99, 3, 17, -1};
  for (uint64_t k = 0; k < 6; ++k)
    EXPECT_EQ(b.get<int16_t>(2 * k), expected[k]) << k;
  EXPECT_EQ(b.get<int16_t>(b.at(1)), 1);
  EXPECT_EQ(b.get<int32_t>(b.at(2)), 200);
  EXPECT_EQ(b.get<int32_t>(b.at(3)), -1);
  EXPECT_EQ(b.get<int16_t>(b.at(4)), 0);
  EXPECT_THAT(words, ElementsAre("e[2]: the new E does not have its value; it starts anew"));
  EXPECT_THAT(text, HasSubstr("values lost: e[0] : E (without err = 2) in 6 places"));
}

TEST_F(CarryOverTest, InheritedFieldsMayMoveBetweenBaseAndOwn) {
  const auto build = [](AppModel &m, bool moved) {
    const ModelType *i = m.elementary(Kind::INT);
    const auto *base = m.structure("Base",
                                   moved ? std::vector<ModelField>{{"n", i}, {"u", i}, {"v", i}}
                                         : std::vector<ModelField>{{"u", i}},
                                   nullptr, Kind::FunctionBlock);
    const auto *mid = moved ? m.structure("Mid", {{"t", i}}, base, Kind::FunctionBlock) : base;
    const auto *own = m.structure("Own",
                                  moved ? std::vector<ModelField>{{"w", i}}
                                        : std::vector<ModelField>{{"v", i}, {"w", i}},
                                  mid, Kind::FunctionBlock);
    m.root("", "fb", own);
    m.root("", "pBase", m.pointer(base));
    m.root("", "pOwn", m.pointer(own));
  };
  build(a, false);
  build(b, true);
  a.ready();
  b.ready();
  a.set<int16_t>(0, 1);
  a.set<int16_t>(2, 2);
  a.set<int16_t>(4, 3);
  a.set<uint64_t>(a.at(1), a.address(0));
  a.set<uint64_t>(a.at(2), a.address(0));
  apply();
  EXPECT_EQ(b.get<int16_t>(2), 1);
  EXPECT_EQ(b.get<int16_t>(4), 2);
  EXPECT_EQ(b.get<int16_t>(8), 3);
  EXPECT_EQ(b.get<uint64_t>(b.at(1)), b.address(0));
  EXPECT_EQ(b.get<uint64_t>(b.at(2)), b.address(0));
  EXPECT_EQ(result.addressesKept, 2U);
}

TEST_F(CarryOverTest, OtherBlocksStartAnewButDerivedOnesKeepTheirBase) {
  const auto build = [](AppModel &m, bool changed) {
    const ModelType *i = m.elementary(Kind::INT);
    const auto *base = m.structure("Base", {{"x", i}}, nullptr, Kind::FunctionBlock);
    const auto *own = m.structure("Own", {{"y", i}}, base, Kind::FunctionBlock);
    const auto *other = m.structure("Other", {{"x", i}}, nullptr, Kind::FunctionBlock);
    auto *renamed =
        m.structure(changed ? "NewName" : "OldName", {{"x", i}}, nullptr, Kind::FunctionBlock);
    renamed->renamedFrom = changed ? "OldName" : "";
    m.root("", "derived", changed ? own : base);
    m.root("", "other", changed ? other : base);
    m.root("", "renamed", renamed);
    m.root("", "s", changed ? m.structure("T", {{"x", i}}) : m.structure("S", {{"x", i}}));
  };
  build(a, false);
  build(b, true);
  a.ready();
  b.ready();
  for (size_t r = 0; r < 4; ++r)
    a.set<int16_t>(a.at(r), 5);
  const std::string text = apply();
  EXPECT_EQ(b.get<int16_t>(b.at(0)), 5);
  EXPECT_EQ(b.get<int16_t>(b.at(1)), 0);
  EXPECT_EQ(b.get<int16_t>(b.at(2)), 5);
  EXPECT_EQ(b.get<int16_t>(b.at(3)), 5);
  EXPECT_THAT(text, HasSubstr("lost: other : Base -> Other"));
  EXPECT_THAT(text, HasSubstr("converted: s : S -> T (by the names of its fields)"));
}

TEST_F(CarryOverTest, Unions) {
  const auto uni = [](AppModel &m, bool changed) {
    std::vector<ModelField> fields = {{"d", m.elementary(Kind::DINT)},
                                      {"l", m.elementary(changed ? Kind::REAL : Kind::LREAL)},
                                      {"b", m.array(m.elementary(Kind::BYTE), 0, 5)}};
    if (changed)
      fields.push_back({"big", m.array(m.elementary(Kind::BYTE), 0, 15)});
    return m.structure("U", std::move(fields), nullptr, Kind::Union);
  };
  a.root("", "u", uni(a, false));
  b.root("", "u", uni(b, true));
  const auto same = [](AppModel &m) {
    return m.structure(
        "P", {{"p", m.pointer(m.elementary(Kind::DINT))}, {"n", m.elementary(Kind::LWORD)}},
        nullptr, Kind::Union);
  };
  a.root("", "p", same(a));
  b.root("", "p", same(b));
  a.root("", "n", same(a));
  b.root("", "n", same(b));
  a.root("", "shift", a.elementary(Kind::LREAL));
  b.root("", "x", b.elementary(Kind::DINT));
  a.root("", "x", a.elementary(Kind::DINT));
  a.ready();
  b.ready();
  std::memset(a.state(), 0x11, 8);
  std::memset(b.state(), 0x22, 16);
  a.set<uint64_t>(a.at(1), a.address(a.at(4)));
  a.set<uint64_t>(a.at(2), 12345678);
  const std::string text = apply();
  EXPECT_EQ(b.get<uint32_t>(0), 0x11111111U);
  EXPECT_EQ(b.get<uint16_t>(4), 0x1111U);
  EXPECT_EQ(b.get<uint16_t>(6), 0x2222U);
  EXPECT_EQ(b.get<uint64_t>(8), 0x2222222222222222U);
  EXPECT_EQ(b.get<uint64_t>(b.at(1)), b.address(b.at(3)));
  EXPECT_EQ(b.get<uint64_t>(b.at(2)), 12345678U); // a number that is no address
  EXPECT_EQ(result.nulled(), 0U);
  EXPECT_THAT(text, HasSubstr("union changed: u : U"));
}
} // namespace
