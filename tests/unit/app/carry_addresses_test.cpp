// Online change on descriptions made by hand: where addresses lead.
#include "carry_fixture.hpp"

namespace {

using namespace stride;
using namespace stride::app;
using stride::test::AppModel;
using stride::test::CarryOverTest;
using stride::test::ModelField;
using stride::test::ModelType;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Everything a pointer may point to, in states whose order is reversed.
class CarryAddresses : public CarryOverTest {
protected:
  uint64_t follow(uint64_t oldOffset, const ModelType *oldPointee, const ModelType *newPointee,
                  Kind kind = Kind::Pointer) {
    a.root("", "probe", a.pointer(oldPointee, kind));
    b.root("", "probe", b.pointer(newPointee, kind));
    a.ready();
    b.ready();
    a.set<uint64_t>(a.at(a.roots.size() - 1), a.address(oldOffset));
    apply();
    const uint64_t address = b.get<uint64_t>(b.at(b.roots.size() - 1));
    return address == 0 ? ~uint64_t{0} : address - b.address(0);
  }
  static constexpr uint64_t kNull = ~uint64_t{0};
};

TEST_F(CarryAddresses, OfAnElementOfAnArrayThatMoved) {
  a.root("", "v", a.array(a.elementary(Kind::REAL), 1, 4));
  b.root("", "w", b.elementary(Kind::LREAL));
  b.root("", "v", b.array(b.elementary(Kind::REAL), 0, 5));
  EXPECT_EQ(follow(8, a.elementary(Kind::REAL), b.elementary(Kind::REAL)), 8U + 12U);
}

TEST_F(CarryAddresses, OfAnElementOutsideOfTheNewBounds) {
  a.root("", "v", a.array(a.elementary(Kind::REAL), 1, 4));
  b.root("", "v", b.array(b.elementary(Kind::REAL), 1, 2));
  EXPECT_EQ(follow(8, a.elementary(Kind::REAL), b.elementary(Kind::REAL)), kNull);
  EXPECT_THAT(words, ElementsAre("probe is now 0: it pointed to v[3], which the new build does not "
                                 "have"));
}

TEST_F(CarryAddresses, OnePastTheEnd) {
  a.root("", "v", a.array(a.elementary(Kind::REAL), 1, 4));
  a.root("", "next", a.elementary(Kind::DINT));
  b.root("", "next", b.elementary(Kind::DINT));
  b.root("", "v", b.array(b.elementary(Kind::REAL), 1, 4));
  // "next" starts there, but it is no REAL
  EXPECT_EQ(follow(16, a.elementary(Kind::REAL), b.elementary(Kind::REAL)), 20U);
}

TEST_F(CarryAddresses, AnObjectOfTheTypeGoesBeforeAnEnd) {
  a.root("", "v", a.array(a.elementary(Kind::REAL), 1, 4));
  a.root("", "next", a.elementary(Kind::REAL));
  b.root("", "next", b.elementary(Kind::REAL));
  b.root("", "v", b.array(b.elementary(Kind::REAL), 1, 4));
  EXPECT_EQ(follow(16, a.elementary(Kind::REAL), b.elementary(Kind::REAL)), 0U);
}

TEST_F(CarryAddresses, OnePastTheEndInFrontOfAnotherPointer) {
  a.root("", "x", a.elementary(Kind::LREAL));
  a.root("", "y", a.elementary(Kind::LREAL));
  b.root("", "y", b.elementary(Kind::LREAL));
  b.root("", "x", b.elementary(Kind::LREAL));
  // the pointer itself starts there, but it is no LREAL: one past y
  EXPECT_EQ(follow(16, a.elementary(Kind::LREAL), b.elementary(Kind::LREAL)), 8U);
}

TEST_F(CarryAddresses, BytesOfATextAndOfANumber) {
  a.root("", "t", a.string(9));
  a.root("", "n", a.elementary(Kind::LINT));
  b.root("", "n", b.elementary(Kind::LINT));
  b.root("", "t", b.string(6));
  EXPECT_EQ(follow(5, a.elementary(Kind::BYTE), b.elementary(Kind::BYTE)), 13U);
}

TEST_F(CarryAddresses, ABytePointerToAStructureThatChanged) {
  const ModelType *i = a.elementary(Kind::INT);
  const ModelType *j = b.elementary(Kind::INT);
  a.root("", "s", a.structure("S", {{"x", i}, {"y", i}}));
  b.root("", "d", b.elementary(Kind::LREAL));
  b.root("", "s", b.structure("S", {{"y", j}, {"x", j}}));
  EXPECT_EQ(follow(0, a.elementary(Kind::BYTE), b.elementary(Kind::BYTE)), 8U); // the structure
}

TEST_F(CarryAddresses, IntoAFieldThatMoved) {
  const ModelType *i = a.elementary(Kind::INT);
  const ModelType *j = b.elementary(Kind::INT);
  a.root("", "s", a.structure("S", {{"x", i}, {"y", i}}));
  b.root("", "s", b.structure("S", {{"y", j}, {"x", j}}));
  EXPECT_EQ(follow(2, i, j), 0U);
}

TEST_F(CarryAddresses, OfAnotherTypeNow) {
  a.root("", "x", a.elementary(Kind::DINT));
  b.root("", "x", b.elementary(Kind::LINT));
  EXPECT_EQ(follow(0, a.elementary(Kind::DINT), b.elementary(Kind::DINT)), kNull);
  EXPECT_THAT(words, ElementsAre("probe is now 0: it pointed to x, which has another type now"));
}

TEST_F(CarryAddresses, NotToTheTypeIdOfAnInstanceThatLiesThereNow) {
  const ModelType *udint = b.elementary(Kind::UDINT);
  a.root("", "v", a.elementary(Kind::UDINT));
  b.root("", "v",
         b.structure("FB", {{"type__", udint, kSymTypeId | kSymHidden}, {"n", udint}}, nullptr,
                     Kind::FunctionBlock));
  EXPECT_EQ(follow(0, a.elementary(Kind::UDINT), udint), kNull);
  EXPECT_THAT(words, ElementsAre("probe is now 0: it pointed to v, which has another type now"));
}

TEST_F(CarryAddresses, ThePointerFollowsTheNewType) {
  a.root("", "x", a.elementary(Kind::DINT));
  b.root("", "x", b.elementary(Kind::LINT));
  EXPECT_EQ(follow(0, a.elementary(Kind::DINT), b.elementary(Kind::LINT), Kind::Reference), 0U);
}

TEST_F(CarryAddresses, LongerTextsAndArraysWillDo) {
  a.root("", "t", a.string(10));
  b.root("", "t", b.string(20));
  EXPECT_EQ(follow(0, a.string(10), b.string(10)), 0U);
}

TEST_F(CarryAddresses, ShorterTextsWillNot) {
  a.root("", "t", a.string(20));
  b.root("", "t", b.string(10));
  EXPECT_EQ(follow(0, a.string(20), b.string(20)), kNull);
}

TEST_F(CarryAddresses, OutsideOfTheState) {
  a.root("", "x", a.elementary(Kind::DINT));
  b.root("", "x", b.elementary(Kind::DINT));
  EXPECT_EQ(follow(1 << 20, a.elementary(Kind::DINT), b.elementary(Kind::DINT)), kNull);
  ASSERT_EQ(words.size(), 1U);
  EXPECT_THAT(words[0], HasSubstr("where no variable lies"));
  const CarryOver plan(a.app(), b.app(), {}, {{a.address(1 << 20), 16}});
  plan.apply(a.state(), b.state(), result);
  EXPECT_EQ(b.get<uint64_t>(b.at(1)), a.address(1 << 20));
}

TEST_F(CarryAddresses, AllSlotsOfManyInstances) {
  const auto build = [](AppModel &m, bool changed) {
    const ModelType *r = m.elementary(Kind::REAL);
    auto *node = m.structure("Node", {}, nullptr, Kind::FunctionBlock);
    const ModelType *next = m.pointer(node);
    std::vector<ModelField> fields = {
        {"value", r}, {"next", next}, {"axis", m.pointer(r, Kind::InOut)}};
    if (changed)
      fields.insert(fields.begin(), {"extra", m.elementary(Kind::LREAL)});
    AppModel::define(*node, std::move(fields));
    m.root("", "nodes", m.array(node, 0, 99));
    return node->size;
  };
  const uint64_t before = build(a, false);
  const uint64_t after = build(b, true);
  a.ready();
  b.ready();
  for (uint64_t i = 0; i < 100; ++i) {
    a.set<uint64_t>(i * before + 8, i == 99 ? 0 : a.address((i + 1) * before));
    a.set<uint64_t>(i * before + 16, a.address((99 - i) * before));
  }
  apply();
  EXPECT_EQ(result.nulled(), 0U);
  for (uint64_t i = 0; i < 100; ++i) {
    EXPECT_EQ(b.get<uint64_t>(i * after + 16), i == 99 ? 0 : b.address((i + 1) * after));
    EXPECT_EQ(b.get<uint64_t>(i * after + 24), b.address((99 - i) * after + 8));
  }
}

TEST_F(CarryAddresses, InterfacesPointToTheTypeIds) {
  // The block has its number in itself; later its base has it.
  const auto build = [](AppModel &m, bool changed) {
    const ModelField id = {"type__", m.elementary(Kind::UDINT), kSymTypeId | kSymHidden};
    const ModelField x = {"x", m.elementary(Kind::INT)};
    const auto *base =
        m.structure("Base", changed ? std::vector<ModelField>{x, id} : std::vector<ModelField>{x},
                    nullptr, Kind::FunctionBlock);
    const ModelField y = {"y", m.elementary(Kind::LREAL)};
    const auto *own =
        m.structure("Own", changed ? std::vector<ModelField>{y} : std::vector<ModelField>{id, y},
                    base, Kind::FunctionBlock);
    const auto *plain =
        m.structure("Plain", changed ? std::vector<ModelField>{x} : std::vector<ModelField>{id, x},
                    nullptr, Kind::FunctionBlock);
    if (changed)
      m.root("", "first", m.elementary(Kind::LREAL));
    m.root("", "fbs", m.array(own, 1, 3));
    m.root("", "plain", plain);
    m.root("", "i", m.pointer(nullptr, Kind::Interface));
    m.root("", "lost", m.pointer(nullptr, Kind::Interface));
    m.root("", "none", m.pointer(nullptr, Kind::Interface));
    return own->size;
  };
  const uint64_t before = build(a, false);
  const uint64_t after = build(b, true);
  a.ready();
  b.ready();
  a.set<uint32_t>(before + 4, 17);
  b.set<uint32_t>(b.at(1) + after + 4, 23);
  a.set<uint64_t>(a.at(2), a.address(before + 4));
  a.set<uint64_t>(a.at(3), a.address(a.at(1)));
  apply();
  EXPECT_EQ(b.get<uint64_t>(b.at(3)), b.address(b.at(1) + after + 4));
  EXPECT_EQ(b.get<uint32_t>(b.at(1) + after + 4), 23U);
  EXPECT_EQ(b.get<uint64_t>(b.at(4)), 0U);
  EXPECT_EQ(b.get<uint64_t>(b.at(5)), 0U);
  EXPECT_THAT(words, ElementsAre("lost is now 0: it pointed to plain, which has no methods in "
                                 "the new build, or is not in it"));
}

/// The objects of __NEW: Node is the same in both builds, Changed is not.
class CarryPool : public CarryOverTest {
protected:
  static constexpr uint64_t kPool = 1024;

  void build(AppModel &m, bool changed) {
    const ModelType *real = m.elementary(Kind::LREAL);
    auto *node = m.structure("Node", {}, nullptr, Kind::FunctionBlock);
    AppModel::define(*node, {{"type__", m.elementary(Kind::UDINT), kSymTypeId | kSymHidden},
                             {"value", real},
                             {"next", m.pointer(node)},
                             {"out", m.pointer(real)}});
    node->hash = 77;
    node->typeId = changed ? 9 : 4;
    auto *other = m.structure("Changed", changed ? std::vector<ModelField>{{"x", real}, {"y", real}}
                                                 : std::vector<ModelField>{{"x", real}});
    other->hash = changed ? 79 : 78;
    if (changed)
      m.root("", "first", m.array(real, 1, 3));
    m.root("", "x", real);
    m.root("", "head", m.pointer(node));
    m.root("", "tail", m.pointer(real));
    m.root("", "lost", m.pointer(other));
    // As the compiler describes it; its maps lie after.
    m.root("", "__pool", m.array(m.elementary(Kind::LWORD), 0, kPool / 8 - 1), kSymHidden);
    m.root("", "maps", m.array(m.elementary(Kind::LWORD), 0, 2 * pool::mapWords(kPool) - 1));
  }
  static uint64_t poolOf(const AppModel &m) { return m.roots[m.roots.size() - 2].offset; }
  /// A block of the old pool, or a gap of its size for hash 0; returns the offset of the object.
  uint64_t block(uint64_t &at, uint64_t hash, uint64_t count, uint64_t elementSize) {
    const PoolBlock header{32 + (count * elementSize + 15) / 16 * 16, hash, count, elementSize};
    const uint64_t place = poolOf(a) + at;
    if (hash != 0) {
      a.set(place, header);
      pool::enter(reinterpret_cast<BYTE *>(a.state() + poolOf(a)), kPool, at);
    }
    at += header.size;
    return place + 32;
  }
};

TEST_F(CarryPool, KeepsObjectsOfUnchangedTypes) {
  build(a, false);
  build(b, true);
  a.ready();
  b.ready();
  uint64_t at = 0;
  const uint64_t first = block(at, 77, 1, 32);
  block(at, 0, 1, 48);
  const uint64_t changed = block(at, 78, 2, 8);
  const uint64_t nodes = block(at, 77, 3, 32);
  const uint64_t x = a.at(0);
  const auto node = [&](uint64_t place, double value, uint64_t next, uint64_t out) {
    a.set<uint32_t>(place, 4);
    a.set<double>(place + 8, value);
    a.set<uint64_t>(place + 16, next);
    a.set<uint64_t>(place + 24, out);
  };
  node(first, 1.5, a.address(nodes + 32), a.address(x));
  node(nodes, 2.5, 0, a.address(changed + 8));
  node(nodes + 32, 3.5, a.address(first), a.address(nodes + 64 + 8));
  node(nodes + 64, 4.5, a.address(nodes), 0);
  a.set<uint64_t>(a.at(1), a.address(first));
  a.set<uint64_t>(a.at(2), a.address(nodes + 96)); // one past the last
  a.set<uint64_t>(a.at(3), a.address(changed));
  apply();
  const uint64_t shift = poolOf(b) - poolOf(a);
  EXPECT_EQ(b.get<uint64_t>(b.at(2)), b.address(first + shift));
  EXPECT_EQ(b.get<uint64_t>(b.at(3)), b.address(nodes + 96 + shift));
  EXPECT_EQ(b.get<uint64_t>(b.at(4)), 0U);
  EXPECT_EQ(b.get<uint32_t>(first + shift), 9U);
  EXPECT_EQ(b.get<uint32_t>(nodes + 64 + shift), 9U);
  EXPECT_EQ(b.get<double>(nodes + 32 + 8 + shift), 3.5);
  EXPECT_EQ(b.get<uint64_t>(first + 16 + shift), b.address(nodes + 32 + shift));
  EXPECT_EQ(b.get<uint64_t>(first + 24 + shift), b.address(b.at(1)));
  EXPECT_EQ(b.get<uint64_t>(nodes + 24 + shift), 0U);
  EXPECT_EQ(b.get<uint64_t>(nodes + 32 + 16 + shift), b.address(first + shift));
  EXPECT_EQ(b.get<uint64_t>(nodes + 32 + 24 + shift), b.address(nodes + 64 + 8 + shift));
  auto *const carried = reinterpret_cast<BYTE *>(b.state() + poolOf(b));
  EXPECT_EQ(pool::find(carried, kPool, b.state() + changed + shift), nullptr); // free
  EXPECT_NE(pool::find(carried, kPool, b.state() + nodes + shift), nullptr);
  EXPECT_EQ(result.objectsGivenUp, 1U);
  EXPECT_THAT(words,
              ElementsAre("lost is now 0: it pointed to an object of __NEW, which has another "
                          "type now",
                          "an object of __NEW is now 0: it pointed to an object of __NEW, "
                          "which has another type now"));
}

} // namespace
