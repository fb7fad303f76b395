// Which variables are stored, and what another build takes of them.
#include "tests/unit/app/app_model.hpp"

#include "runtime/app/checksum.hpp"
#include "runtime/app/retain_image.hpp"
#include "runtime/app/validate.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

namespace {

using namespace stride;
using app::RetainImage;
using app::RetainLayout;
using app::RetainReport;
using app::RetainRestore;
using test::ModelField;
using test::ModelType;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Build : test::AppModel {
  std::vector<uint64_t> memory;
  void ready(uint64_t hash) {
    finish();
    app().buildHash = hash;
    app::validate(app(), {});
    memory.assign(app().stateSize / 8 + 2, 0);
  }
  std::byte *state() { return reinterpret_cast<std::byte *>(memory.data()); }
  template <class T> void set(uint64_t offset, T value) {
    std::memcpy(state() + offset, &value, sizeof value);
  }
  template <class T> T get(uint64_t offset) {
    T value;
    std::memcpy(&value, state() + offset, sizeof value);
    return value;
  }
  uint64_t at(size_t root) const { return roots[root].offset; }
};

/// Through the bytes of a file.
RetainImage imageOf(Build &build) {
  const RetainLayout layout(build.app(), app::kRetained);
  std::vector<std::byte> values(layout.bytes());
  app::copyRetained(build.state(), layout.ranges(), values.data());
  return app::decodeImage(
      app::encodeImage({"model", build.app().buildHash, 7}, layout.encode(), values));
}

class RetainImageTest : public ::testing::Test {
protected:
  Build a;
  Build b;
  bool keepsRetains = false;

  RetainReport restore() { return restore(imageOf(a)); }
  RetainReport restore(const RetainImage &image) {
    const RetainLayout layout(b.app(), app::kRetained);
    const RetainRestore plan(b.app(), layout, image);
    keepsRetains = plan.keepsRetains();
    return plan.apply(b.state());
  }
};

TEST(Checksum, IsCrc64Xz) {
  constexpr std::string_view kText = "123456789";
  EXPECT_EQ(app::crc64(std::as_bytes(std::span(kText))), 0x995DC9BBDF1939FAULL);
  EXPECT_EQ(app::crc64(std::as_bytes(std::span(kText.substr(4))),
                       app::crc64(std::as_bytes(std::span(kText.substr(0, 4))))),
            0x995DC9BBDF1939FAULL);
}

TEST(CopyRetained, CopiesAnyRange) {
  std::vector<uint64_t> memory(16);
  auto *const state = reinterpret_cast<std::byte *>(memory.data());
  for (size_t i = 0; i < 128; ++i)
    state[i] = static_cast<std::byte>(i + 1);
  for (uint64_t offset = 0; offset < 20; ++offset) {
    for (uint64_t size = 0; size < 40; ++size) {
      const app::RetainRange range{offset, size, kNoIndex};
      std::vector<std::byte> out(size + 1, std::byte{0xEE});
      app::copyRetained(state, {&range, 1}, out.data());
      EXPECT_EQ(std::memcmp(out.data(), state + offset, size), 0) << offset << ' ' << size;
      EXPECT_EQ(out[size], std::byte{0xEE});
    }
  }
}

TEST_F(RetainImageTest, StoresWhatIsDeclaredAndWhatIsInside) {
  const ModelType *dint = a.elementary(Kind::DINT);
  const ModelType *inner =
      a.structure("Inner", {{"p", a.pointer(dint)}, {"n", dint}, {"fix", dint, kSymConstant}});
  const ModelType *block = a.structure(
      "Block", {{"plain", dint}, {"kept", dint, kSymRetain}, {"own", inner, kSymPersistent}},
      nullptr, Kind::FunctionBlock);
  a.root("", "Main",
         a.structure("Main", {{"x", dint}, {"fb", a.array(block, 1, 2)}}, nullptr, Kind::Program));
  a.root("GVL", "whole", inner, kSymRetain);
  a.root("GVL", "nothing", inner);
  a.root("GVL", "constant", dint, kSymRetain | kSymConstant);
  a.ready(1);
  const RetainLayout layout(a.app(), app::kRetained);
  EXPECT_THAT(layout.variables(),
              ElementsAre("Main.fb[1..2].kept", "Main.fb[1..2].own", "GVL.whole"));
  EXPECT_TRUE(RetainLayout::decode(layout.encode()).sameAs(layout));
  // Main: x at 0, blocks of 24 bytes from 8 on, in them kept at 4 and own.n at 16.
  a.set<int32_t>(8 + 4, 11);
  a.set<uint64_t>(8 + 8, 0x1234);
  a.set<int32_t>(8 + 16, 12);
  a.set<int32_t>(8 + 24 + 16, 13);
  a.set<int32_t>(a.at(1) + 8, 14);
  a.set<int32_t>(8, 99);
  const RetainImage image = imageOf(a);
  a.memory.assign(a.memory.size(), 0);
  const RetainRestore plan(a.app(), layout, image);
  EXPECT_TRUE(plan.keepsRetains());
  const RetainReport report = plan.apply(a.state());
  EXPECT_THAT(report.lost, IsEmpty());
  EXPECT_EQ(report.kept, 5U);
  EXPECT_EQ(a.get<int32_t>(8 + 4), 11);
  EXPECT_EQ(a.get<uint64_t>(8 + 8), 0U) << "an address is never put back";
  EXPECT_EQ(a.get<int32_t>(8 + 16), 12);
  EXPECT_EQ(a.get<int32_t>(8 + 24 + 16), 13);
  EXPECT_EQ(a.get<int32_t>(a.at(1) + 8), 14);
  EXPECT_EQ(a.get<int32_t>(8), 0);
}

TEST_F(RetainImageTest, AnotherBuildTakesPersistentVariablesOnly) {
  for (Build *build : {&a, &b}) {
    const bool before = build == &a;
    const ModelType *dint = build->elementary(Kind::DINT);
    if (!before)
      build->root("GVL", "fresh", dint, kSymPersistent);
    build->root("GVL", "retain", dint, kSymRetain);
    build->root("GVL", "persistent", dint, kSymRetain | kSymPersistent);
    build->root("GVL", "wider", before ? build->elementary(Kind::INT) : dint, kSymPersistent);
    build->root("GVL", "other", before ? dint : build->elementary(Kind::BOOL), kSymPersistent);
    if (before)
      build->root("GVL", "gone", dint, kSymPersistent);
    build->root("GVL", before ? "old" : "renamed", dint, kSymPersistent, before ? "" : "old");
    build->root("GVL", "plainNow", dint, before ? uint32_t{kSymPersistent} : 0U);
    build->root("GVL", "persistentNow", dint, before ? kSymRetain : kSymPersistent);
    build->root("GVL", "text", build->string(before ? 10 : 3), kSymPersistent);
    build->ready(before ? 1 : 2);
  }
  for (size_t i = 0; i < 2; ++i)
    a.set<int32_t>(a.at(i), static_cast<int32_t>(10 + i));
  a.set<int16_t>(a.at(2), -3);
  for (size_t i = 3; i < 8; ++i)
    a.set<int32_t>(a.at(i), static_cast<int32_t>(10 + i));
  std::memcpy(a.state() + a.at(8), "abcdef", 7);
  const RetainReport report = restore();
  EXPECT_FALSE(keepsRetains);
  EXPECT_THAT(
      report.lost,
      ::testing::UnorderedElementsAre(
          "GVL.retain is not restored: this is another build of the program, and only PERSISTENT "
          "variables survive that, not RETAIN",
          "GVL.other is not restored: it was DINT and is BOOL",
          "GVL.gone is not restored: the program does not have it any more",
          "GVL.plainNow is not restored: it is neither RETAIN nor PERSISTENT any more",
          "GVL.text: its text was cut to 3 characters"));
  EXPECT_THAT(report.notes,
              ::testing::UnorderedElementsAre("GVL.wider was INT and is DINT: converted",
                                              "GVL.renamed was GVL.old"));
  EXPECT_EQ(b.get<int32_t>(b.at(0)), 0);
  EXPECT_EQ(b.get<int32_t>(b.at(1)), 0);
  EXPECT_EQ(b.get<int32_t>(b.at(2)), 11);
  EXPECT_EQ(b.get<int32_t>(b.at(3)), -3);
  EXPECT_EQ(b.get<uint8_t>(b.at(4)), 0);
  EXPECT_EQ(b.get<int32_t>(b.at(5)), 15);
  EXPECT_EQ(b.get<int32_t>(b.at(6)), 0);
  EXPECT_EQ(b.get<int32_t>(b.at(7)), 17);
  EXPECT_STREQ(reinterpret_cast<char *>(b.state() + b.at(8)), "abc");
}

/// A variable at an address may be renamed within its list, or have come from another one.
TEST_F(RetainImageTest, RenamedVariablesInTheProcessImage) {
  for (Build *build : {&a, &b}) {
    const bool before = build == &a;
    const ModelType *dint = build->elementary(Kind::DINT);
    const uint32_t flags = kSymLocated | kSymPersistent;
    build->root("GVL", before ? "old" : "renamed", dint, flags, before ? "" : "old");
    build->root(before ? "Other" : "GVL", before ? "there" : "here", dint, flags,
                before ? "" : "Other.there");
    build->root("GVL", "same", dint, flags);
    build->ready(before ? 1 : 2);
  }
  for (size_t i = 0; i < 3; ++i)
    a.set<int32_t>(a.at(i), static_cast<int32_t>(21 + i));
  EXPECT_THAT(restore().lost, IsEmpty());
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(b.get<int32_t>(b.at(i)), static_cast<int32_t>(21 + i)) << i;
}

/// The old name of a renamed variable may be used anew: nothing of the new one is lost.
TEST_F(RetainImageTest, TheNameOfARenamedVariableIsFree) {
  for (Build *build : {&a, &b}) {
    const bool before = build == &a;
    const ModelType *dint = build->elementary(Kind::DINT);
    if (!before)
      build->root("GVL", "fresh", dint, kSymPersistent, "old");
    build->root("GVL", "old", dint, kSymPersistent);
    build->ready(before ? 1 : 2);
  }
  a.set<int32_t>(a.at(0), 41);
  const RetainReport report = restore();
  EXPECT_THAT(report.lost, IsEmpty());
  EXPECT_THAT(report.notes, ElementsAre("GVL.fresh was GVL.old"));
  EXPECT_EQ(b.get<int32_t>(b.at(0)), 41);
  EXPECT_EQ(b.get<int32_t>(b.at(1)), 0);
}

/// Why something is lost does not depend on the bounds of the array that it is in.
TEST_F(RetainImageTest, RetainInAnArrayWithOtherBounds) {
  for (Build *build : {&a, &b}) {
    const ModelType *block =
        build->structure("Block", {{"kept", build->elementary(Kind::DINT), kSymRetain}}, nullptr,
                         Kind::FunctionBlock);
    build->root("GVL", "blocks", build->array(block, build == &a ? 1 : 0, 2));
    build->ready(build == &a ? 1 : 2);
  }
  EXPECT_THAT(restore().lost,
              ElementsAre("GVL.blocks[1..2].kept is not restored: this is another build of the "
                          "program, and only PERSISTENT variables survive that, not RETAIN"));
}

TEST_F(RetainImageTest, AFieldThatIsGoneIsSaid) {
  for (Build *build : {&a, &b}) {
    const ModelType *dint = build->elementary(Kind::DINT);
    std::vector<ModelField> fields = {{"x", dint}, {"y", dint}, {"z", dint}};
    if (build == &b)
      fields.erase(fields.begin() + 1);
    build->root("GVL", "s", build->structure("S", fields), kSymPersistent);
    build->ready(build == &a ? 1 : 2);
  }
  for (size_t i = 0; i < 3; ++i)
    a.set<int32_t>(4 * i, static_cast<int32_t>(31 + i));
  EXPECT_THAT(restore().lost,
              ElementsAre("GVL.s.y is not restored: the program does not have it any more"));
  EXPECT_EQ(b.get<int32_t>(0), 31);
  EXPECT_EQ(b.get<int32_t>(4), 33);
}

TEST_F(RetainImageTest, ResetColdKeepsPersistentVariables) {
  const ModelType *dint = a.elementary(Kind::DINT);
  a.root("G", "r", dint, kSymRetain);
  a.root("G", "p", dint, kSymPersistent);
  a.ready(5);
  a.set<int32_t>(0, 1);
  a.set<int32_t>(4, 2);
  const RetainLayout layout(a.app(), app::kRetained);
  const RetainImage whole = imageOf(a);
  for (const uint32_t keep : {uint32_t{kSymPersistent}, 0U}) {
    const RetainImage image = app::withoutRetains(whole, keep);
    const RetainImage again =
        app::decodeImage(app::encodeImage(image.head, image.layout.encode(), image.values));
    a.set<int32_t>(0, 0);
    a.set<int32_t>(4, 0);
    const RetainRestore plan(a.app(), layout, again);
    EXPECT_FALSE(plan.keepsRetains()) << "FB_Init is told to initialise RETAIN variables";
    EXPECT_THAT(plan.apply(a.state()).lost, IsEmpty());
    EXPECT_EQ(a.get<int32_t>(0), 0);
    EXPECT_EQ(a.get<int32_t>(4), keep != 0 ? 2 : 0);
  }
}

TEST_F(RetainImageTest, SingleBitsAndTheProcessImage) {
  for (Build *build : {&a, &b}) {
    const ModelType *boolean = build->elementary(Kind::BOOL);
    const ModelType *dint = build->elementary(Kind::DINT);
    ModelType *bits = build->structure(
        "Bits",
        {{"b0", boolean, kSymBit}, {"b1", boolean, kSymBit | kSymRetain | 1U << kSymBitShift}},
        nullptr, Kind::FunctionBlock);
    bits->offsets = {0, 0};
    bits->size = 1;
    build->root("", "bits", bits);
    ModelType *main = build->structure(
        "Main",
        {{"located", dint, kSymLocated | kSymRetain},
         {"bit", boolean, kSymLocated | kSymRetain | kSymBit | 5U << kSymBitShift}},
        nullptr, Kind::Program);
    build->root("", "Main", main);
    build->root("", "%M", build->array(build->elementary(Kind::BYTE), 0, 15), kSymHidden);
    main->offsets = {24, 23}; // within %M, from the start of the state
    main->size = 1;
    build->ready(1);
    ASSERT_LE(build->at(2), 23U);
    ASSERT_LE(28U, build->app().stateSize);
  }
  a.set<uint8_t>(0, 3);
  a.set<int32_t>(24, 77);
  a.set<uint8_t>(23, 0xFF);
  EXPECT_THAT(restore().lost, IsEmpty());
  EXPECT_TRUE(keepsRetains);
  EXPECT_EQ(b.get<uint8_t>(0), 2) << "the bit beside it is not RETAIN";
  EXPECT_EQ(b.get<int32_t>(24), 77);
  EXPECT_EQ(b.get<uint8_t>(23), 1U << 5);
}

TEST_F(RetainImageTest, NonRetainAndChangedNativeBlocks) {
  for (Build *build : {&a, &b}) {
    const ModelType *dint = build->elementary(Kind::DINT);
    ModelType *native = build->structure("NATIVE", {{"s", dint}}, nullptr, Kind::FunctionBlock);
    native->flags = kTypeExternal;
    native->hash = build == &a ? 1 : 2;
    build->root("", "native", native, kSymPersistent);
    build->root("", "fb",
                build->structure("FB", {{"x", dint}, {"y", dint, kSymNonRetain}}, nullptr,
                                 Kind::FunctionBlock),
                kSymPersistent);
    build->ready(build == &a ? 1 : 2);
  }
  a.set<int32_t>(0, 1);
  a.set<int32_t>(4, 2);
  a.set<int32_t>(8, 3);
  EXPECT_THAT(restore().lost,
              ElementsAre("native is not restored: NATIVE has a native body and other fields now"));
  EXPECT_EQ(b.get<int32_t>(0), 0);
  EXPECT_EQ(b.get<int32_t>(4), 2);
  EXPECT_EQ(b.get<int32_t>(8), 0);
}

TEST_F(RetainImageTest, OnlyWhatHasMembersIsABase) {
  a.root("G", "r", a.structure("S", {{"a", a.elementary(Kind::DINT)}}), kSymRetain);
  a.ready(5);
  const RetainLayout layout(a.app(), app::kRetained);
  const std::vector<std::byte> values(layout.bytes());
  std::vector<std::byte> bytes = app::encodeImage({"model", 5, 1}, layout.encode(), values);
  const std::string_view text(reinterpret_cast<const char *>(bytes.data()), bytes.size());
  const size_t member = text.find(std::string_view("\1\0\0\0a", 5));
  ASSERT_NE(member, std::string_view::npos);
  EXPECT_NO_THROW(static_cast<void>(app::decodeImage(bytes, false)));
  bytes[member + 5 + 8 + 4] |= std::byte{kSymBase}; // after its name, offset and type
  EXPECT_THROW(static_cast<void>(app::decodeImage(bytes, false)), app::Error);
}

TEST_F(RetainImageTest, DamagedBytesAreNoImage) {
  const ModelType *dint = a.elementary(Kind::DINT);
  a.root("G", "r", a.array(a.structure("S", {{"a", dint}, {"t", a.string(5)}}), 0, 3), kSymRetain);
  a.ready(5);
  const RetainLayout layout(a.app(), app::kRetained);
  std::vector<std::byte> values(layout.bytes());
  const std::vector<std::byte> good = app::encodeImage({"model", 5, 1}, layout.encode(), values);
  EXPECT_NO_THROW(static_cast<void>(app::decodeImage(good)));
  for (size_t size = 0; size < good.size(); ++size)
    EXPECT_THROW(static_cast<void>(app::decodeImage(std::span(good).first(size))), app::Error);
  for (size_t i = 0; i < good.size(); ++i) {
    for (const unsigned bit : {0U, 7U}) {
      std::vector<std::byte> bad = good;
      bad[i] ^= std::byte{1} << bit;
      EXPECT_THROW(static_cast<void>(app::decodeImage(bad)), app::Error) << i;
      // What a checksum lets through is distrusted all the same.
      try {
        const RetainImage image = app::decodeImage(bad, false);
        const RetainRestore plan(a.app(), layout, image);
        static_cast<void>(plan.apply(a.state()));
      } catch (const app::Error &) {
        continue;
      }
    }
  }
  // A version that is damaged is no version: the other image is taken, the start is not refused.
  std::vector<std::byte> damaged = good;
  damaged[8] ^= std::byte{4};
  try {
    static_cast<void>(app::decodeImage(damaged));
    FAIL();
  } catch (const app::RetainVersionError &) {
    FAIL() << "taken for another version";
  } catch (const app::Error &) { // which says that it is damaged
  }
  const auto withVersion = [&](std::byte version, bool frontCounts) {
    std::vector<std::byte> other = good;
    other[8] = version;
    const std::span<const std::byte> front = std::span(other).first(20);
    const std::span<const std::byte> rest = std::span(other).subspan(28);
    const uint64_t sum = app::crc64(rest, frontCounts ? app::crc64(front) : 0);
    std::memcpy(other.data() + 20, &sum, sizeof sum);
    return other;
  };
  EXPECT_THROW(static_cast<void>(app::decodeImage(withVersion(std::byte{3}, true))),
               app::RetainVersionError);
  EXPECT_THROW(static_cast<void>(app::decodeImage(withVersion(std::byte{1}, false))),
               app::RetainVersionError);
  // The same of the first version: told apart only where it is not damaged.
  std::vector<std::byte> first = withVersion(std::byte{1}, false);
  first.back() ^= std::byte{1};
  try {
    static_cast<void>(app::decodeImage(first));
    FAIL();
  } catch (const app::Error &error) {
    EXPECT_STREQ(error.what(), "its checksum is wrong");
  }
}

TEST_F(RetainImageTest, LowerBoundsOfArraysAreReadWithinTheirLimits) {
  constexpr int64_t kMost = int64_t{1} << 40;
  for (const int64_t low :
       {-kMost - 1, -kMost, -kMost + 1, int64_t{-7}, kMost - 1, kMost, kMost + 1}) {
    Build build;
    build.root("G", "r", build.array(build.elementary(Kind::DINT), low, low + 2), kSymRetain);
    build.finish();
    const std::vector<std::byte> encoded = RetainLayout(build.app(), app::kRetained).encode();
    if (low < -kMost || low > kMost) {
      EXPECT_THROW(static_cast<void>(RetainLayout::decode(encoded)), app::Error) << low;
      continue;
    }
    const RetainLayout layout = RetainLayout::decode(encoded);
    EXPECT_EQ(layout.description().types[layout.description().roots[0].type].lowerBound, low);
  }
}

TEST_F(RetainImageTest, RangesBelongToTheTaskOfTheirProgram) {
  const ModelType *dint = a.elementary(Kind::DINT);
  a.root("", "One", a.structure("One", {{"x", dint, kSymRetain}}, nullptr, Kind::Program));
  a.root("", "Two", a.structure("Two", {{"x", dint, kSymRetain}}, nullptr, Kind::Program));
  a.root("G", "x", dint, kSymRetain);
  a.ready(1);
  std::vector<RootDesc> roots(a.app().roots, a.app().roots + a.app().rootCount);
  roots[0].task = 1;
  roots[1].task = 0;
  a.app().roots = roots.data();
  const RetainLayout layout(a.app(), app::kRetained);
  using app::RetainRange;
  EXPECT_THAT(layout.ranges(),
              ElementsAre(RetainRange{4, 4, 0}, RetainRange{0, 4, 1}, RetainRange{8, 4, kNoIndex}));
}

} // namespace
