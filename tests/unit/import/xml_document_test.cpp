// Reading XML of other tools: lines of nodes, and what is refused.
#include "compiler/import/xml_document.hpp"

#include <gtest/gtest.h>

namespace {

using stc::import::readXml;

TEST(XmlDocument, SaysTheLineOfANode) {
  const auto document = readXml("<a>\n  <b/>\n\n  <c x='1'>text</c>\n</a>\n");
  ASSERT_EQ(document->problem, "");
  EXPECT_EQ(document->lineOf(document->tree.child("a")), 1U);
  EXPECT_EQ(document->lineOf(document->tree.child("a").child("b")), 2U);
  EXPECT_EQ(document->lineOf(document->tree.child("a").child("c")), 4U);
}

TEST(XmlDocument, RefusesWhatIsNotWellFormed) {
  const auto document = readXml("<a>\n<b>\n</a>\n");
  EXPECT_NE(document->problem.find("not well-formed"), std::string::npos) << document->problem;
  EXPECT_EQ(document->problemLine, 3U);
}

TEST(XmlDocument, RefusesEntitiesThatAFileDeclares) {
  const auto document =
      readXml("<?xml version='1.0'?>\n<!DOCTYPE a [<!ENTITY b 'x'>]>\n<a>&b;</a>");
  EXPECT_NE(document->problem.find("DOCTYPE"), std::string::npos) << document->problem;
  EXPECT_EQ(document->problemLine, 2U);
  EXPECT_FALSE(document->tree.first_child());
}

std::string nested(size_t depth) {
  std::string text;
  for (size_t i = 0; i < depth; ++i)
    text += "<a>";
  for (size_t i = 0; i < depth; ++i)
    text += "</a>";
  return text;
}

TEST(XmlDocument, LimitsTheDepth) {
  EXPECT_EQ(readXml(nested(199))->problem, "");
  EXPECT_EQ(readXml(nested(200))->problem, "");
  EXPECT_NE(readXml(nested(201))->problem, "");
  EXPECT_NE(readXml(nested(300'000))->problem, "");
}

} // namespace
