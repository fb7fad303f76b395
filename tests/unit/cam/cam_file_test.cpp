// *.CAM files: the bytes, there and back, and that nothing damaged is taken for a cam.
#include "runtime/numeric/cam/cam_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace {

namespace cam = stride::cam;

std::vector<uint8_t> bytesOf(const cam::CamFileHeader &header, const void *elements,
                             const std::vector<cam::FileTappet> &tappets) {
  std::vector<uint8_t> bytes(static_cast<size_t>(cam::camFileSize(header)), 0xAA);
  cam::writeCamFile(header, elements, tappets.data(), bytes.data());
  return bytes;
}

cam::CamFileHeader nodesHeader() {
  cam::CamFileHeader header;
  header.elements = 2;
  header.tappets = 1;
  header.start = 0;
  header.end = 360;
  std::strcpy(header.name, "Press");
  return header;
}

const std::vector<cam::Node> kNodes = {{0, 0, 0, 0}, {360, 100, 0, 0}};
const std::vector<cam::FileTappet> kTappets = {{90, 3, 1, 2, 0x7777, 1000, 2000}};

cam::CamFileError errorOf(const std::vector<uint8_t> &bytes) {
  cam::CamFile file;
  return cam::openCamFile(bytes.data(), static_cast<int64_t>(bytes.size()), file);
}

TEST(CamFile, HasTheBytesThatAreDocumented) {
  const std::vector<uint8_t> bytes = bytesOf(nodesHeader(), kNodes.data(), kTappets);
  ASSERT_EQ(bytes.size(), 136U + 64 + 24 + 4);
  EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + 8), "\x89"
                                                           "CAM\r\n\x1a\n");
  EXPECT_EQ(std::vector<uint8_t>(bytes.begin() + 8, bytes.begin() + 24),
            (std::vector<uint8_t>{1, 0, 3, 0, 0, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0}));
  double end = 0;
  std::memcpy(&end, &bytes[32], sizeof end);
  EXPECT_EQ(end, 360.0);
  EXPECT_STREQ(reinterpret_cast<const char *>(&bytes[48]), "Press");
  double y = 0;
  std::memcpy(&y, &bytes[136 + 32 + 8], sizeof y);
  EXPECT_EQ(y, 100.0);
  EXPECT_EQ(std::vector<uint8_t>(bytes.begin() + 136 + 64 + 8, bytes.begin() + 136 + 64 + 24),
            (std::vector<uint8_t>{3, 0, 1, 0, 2, 0, 0, 0, 0xE8, 3, 0, 0, 0xD0, 7, 0, 0}));
  // The checksum of IEEE 802.3: that of "123456789" is known.
  EXPECT_EQ(cam::camFileChecksum(0, "123456789", 9), 0xCBF43926U);
  EXPECT_EQ(cam::camFileChecksum(cam::camFileChecksum(0, "1234", 4), "56789", 5), 0xCBF43926U);
  uint32_t checksum = 0;
  std::memcpy(&checksum, &bytes[bytes.size() - 4], sizeof checksum);
  EXPECT_EQ(checksum, cam::camFileChecksum(0, bytes.data(), 136 + 64 + 24));
}

TEST(CamFile, ComesBackAsItWas) {
  const std::vector<uint8_t> bytes = bytesOf(nodesHeader(), kNodes.data(), kTappets);
  cam::CamFile file;
  ASSERT_EQ(cam::openCamFile(bytes.data(), static_cast<int64_t>(bytes.size()), file),
            cam::CamFileError::None);
  EXPECT_EQ(file.header.form, cam::Form::Nodes);
  EXPECT_EQ(file.header.elements, 2U);
  EXPECT_EQ(file.header.end, 360.0);
  EXPECT_STREQ(file.header.name, "Press");
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): to the byte
  EXPECT_EQ(std::memcmp(file.elements, kNodes.data(), 64), 0);
  ASSERT_EQ(file.header.tappets, 1U);
  EXPECT_EQ(file.tappets[0].x, 90.0);
  EXPECT_EQ(file.tappets[0].group, 3);
  EXPECT_EQ(file.tappets[0].delay, 1000U);
}

TEST(CamFile, HoldsEveryFormAndEveryTypeOfNumbers) {
  struct Table {
    int16_t numbers[3] = {0, 50, 100};
    int16_t gap = 0x5555; // between the numbers and the scaling
    cam::TableScaling scaling{0, 360, 0, 100, 0, 360, 0, 200};
  } table;
  cam::CamFileHeader header = nodesHeader();
  header.form = cam::Form::EvenTable;
  header.element = cam::Element::Int;
  header.elements = 3;
  header.tappets = 0;
  header.cubic = true;
  header.open = true;
  header.rise = 7;
  const std::vector<uint8_t> bytes = bytesOf(header, &table, {});
  ASSERT_EQ(bytes.size(), 136U + 40 + 4);
  EXPECT_EQ(bytes[136 + 6], 0) << "what lies between members is not written";
  EXPECT_EQ(bytes[136 + 7], 0);
  cam::CamFile file;
  ASSERT_EQ(cam::openCamFile(bytes.data(), static_cast<int64_t>(bytes.size()), file),
            cam::CamFileError::None);
  EXPECT_TRUE(file.header.cubic);
  EXPECT_TRUE(file.header.open);
  uint32_t index = 0;
  const cam::Curve curve = cam::curveOfFile(file.header, file.elements);
  EXPECT_EQ(cam::evaluateCurve(curve, 120, true, index).y, 25.0); // the second number, scaled
  EXPECT_EQ(cam::riseOf(curve), 7.0);

  std::vector<cam::Segment> segments(2);
  std::memset(segments.data(), 0xEE, segments.size() * sizeof segments[0]);
  for (size_t i = 0; i < 2; ++i) {
    cam::Segment &segment = segments[i];
    segment.start = static_cast<double>(i) * 180.0;
    segment.end = segment.start + 180.0;
    for (double &coefficient : segment.coefficients)
      coefficient = 0.0;
    segment.stroke = segment.lawBegin = segment.parameter = 0.0;
    segment.lawEnd = 1.0;
    segment.law = cam::Law::Polynomial;
  }
  header = nodesHeader();
  header.form = cam::Form::Segments;
  const std::vector<uint8_t> withSegments = bytesOf(header, segments.data(), kTappets);
  EXPECT_EQ(errorOf(withSegments), cam::CamFileError::None);
  for (size_t i = 122; i < 128; ++i) // after the law
    EXPECT_EQ(withSegments[136 + i], 0);
}

TEST(CamFile, WritesTheSameBytesInPieces) {
  const cam::CamFileHeader header = nodesHeader();
  const std::vector<uint8_t> whole = bytesOf(header, kNodes.data(), kTappets);
  for (const int64_t piece : {1, 7, 8, 50}) {
    std::vector<uint8_t> bytes(64 + 24);
    for (int64_t at = 0; at < 64; at += piece)
      cam::writeFileElements(header, kNodes.data(), at, &bytes[static_cast<size_t>(at)],
                             std::min<int64_t>(piece, 64 - at));
    for (int64_t at = 0; at < 24; at += piece)
      cam::writeFileTappets(kTappets.data(), at, &bytes[static_cast<size_t>(64 + at)],
                            std::min<int64_t>(piece, 24 - at));
    EXPECT_EQ(bytes, std::vector<uint8_t>(whole.begin() + 136, whole.end() - 4)) << piece;
  }
}

TEST(CamFile, NoDamageGoesUnnoticed) {
  const std::vector<uint8_t> good = bytesOf(nodesHeader(), kNodes.data(), kTappets);
  for (size_t length = 0; length < good.size(); ++length)
    EXPECT_EQ(errorOf({good.begin(), good.begin() + static_cast<ptrdiff_t>(length)}),
              cam::CamFileError::Truncated)
        << length;
  for (size_t at = 0; at < good.size(); ++at)
    for (int bit = 0; bit < 8; ++bit) {
      std::vector<uint8_t> bytes = good;
      bytes[at] = static_cast<uint8_t>(bytes[at] ^ (1U << bit));
      EXPECT_NE(errorOf(bytes), cam::CamFileError::None) << at;
    }
  std::vector<uint8_t> longer = good;
  longer.push_back(0);
  EXPECT_EQ(errorOf(longer), cam::CamFileError::Damaged);
}

/// With the right checksum, so that it is the value that is refused.
cam::CamFileError errorWith(size_t at, std::vector<uint8_t> values) {
  std::vector<uint8_t> bytes = bytesOf(nodesHeader(), kNodes.data(), kTappets);
  std::copy(values.begin(), values.end(), bytes.begin() + static_cast<ptrdiff_t>(at));
  const uint32_t checksum =
      cam::camFileChecksum(0, bytes.data(), static_cast<int64_t>(bytes.size()) - 4);
  std::memcpy(&bytes[bytes.size() - 4], &checksum, sizeof checksum);
  return errorOf(bytes);
}

TEST(CamFile, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(errorWith(0, {'C'}), cam::CamFileError::Version);
  EXPECT_EQ(errorWith(8, {2}), cam::CamFileError::Version);
  EXPECT_EQ(errorWith(10, {5}), cam::CamFileError::Form);
  EXPECT_EQ(errorWith(11, {1}), cam::CamFileError::Form); // nodes are no numbers
  EXPECT_EQ(errorWith(14, {1}), cam::CamFileError::Damaged);
  EXPECT_EQ(errorWith(16, {0}), cam::CamFileError::Damaged);
  EXPECT_EQ(errorWith(16, {0, 0, 0, 1}), cam::CamFileError::Damaged);
  EXPECT_EQ(errorWith(16, {3}), cam::CamFileError::Truncated);
  EXPECT_EQ(errorWith(38, {0xF8, 0x7F}), cam::CamFileError::Damaged); // xEnd is no number
  EXPECT_EQ(errorWith(136 + 32 + 6, {0xF0, 0x7F}),
            cam::CamFileError::Damaged);                        // a node at infinity
  EXPECT_EQ(errorWith(128, {'x'}), cam::CamFileError::Damaged); // a name without an end
}

} // namespace
