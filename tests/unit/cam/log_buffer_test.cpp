// What lies between the two tasks of SMC_AxisDiagnosticLog: nothing is lost, doubled or torn
// between two threads.
#include "runtime/iec/ctx.h"

#include "st/SM_FileFBs/SMC_LOG_BUFFER.h"
#include "st/SM_FileFBs/SMC_LogClose.h"
#include "st/SM_FileFBs/SMC_LogEnd.h"
#include "st/SM_FileFBs/SMC_LogPut.h"
#include "st/SM_FileFBs/SMC_LogResult.h"
#include "st/SM_FileFBs/SMC_LogStart.h"
#include "st/SM_FileFBs/SMC_LogState.h"
#include "st/SM_FileFBs/SMC_LogText.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

namespace {

using namespace st::SM_FileFBs;
using Values = ::stride::Array<::stride::LREAL, 0, 5>;

std::string take(::stride::Ctx &ctx, SMC_LOG_BUFFER &buffer, uint32_t room = 16384) {
  std::vector<uint8_t> text(room);
  uint8_t end[4] = {'\n', 0, 0, 0};
  const uint32_t length = SMC_LogText(ctx, buffer, text.data(), room, ';', end);
  return {text.begin(), text.begin() + length};
}

TEST(LogBuffer, WritesRecordsAndSaysWhenItIsFull) {
  ::stride::Ctx ctx{};
  SMC_LOG_BUFFER buffer{};
  EXPECT_EQ(SMC_LogState(ctx, buffer), 0);
  ASSERT_TRUE(SMC_LogStart(ctx, buffer, 3));
  EXPECT_FALSE(SMC_LogStart(ctx, buffer, 3)) << "the run before is not closed";
  EXPECT_EQ(SMC_LogResult(ctx, buffer), -1);
  Values values{{1.5, -2.0, 1e-7, 0, 0, 0}};
  for (int i = 0; i < 640 / 3; ++i)
    ASSERT_TRUE(SMC_LogPut(ctx, buffer, values)) << i;
  EXPECT_FALSE(SMC_LogPut(ctx, buffer, values));
  std::string text = take(ctx, buffer, 200);
  EXPECT_EQ(text.substr(0, text.find('\n') + 1), "1.5;-2.0;1.0e-07\n");
  EXPECT_EQ(text.size() % 17, 0U) << "whole records only";
  EXPECT_TRUE(SMC_LogPut(ctx, buffer, values));
  SMC_LogEnd(ctx, buffer);
  EXPECT_EQ(SMC_LogState(ctx, buffer), 1);
  text += take(ctx, buffer);
  EXPECT_EQ(text.size(), (640 / 3 + 1) * 17U);
  EXPECT_EQ(SMC_LogState(ctx, buffer), 2);
  SMC_LogClose(ctx, buffer, 2100);
  EXPECT_EQ(SMC_LogResult(ctx, buffer), 2100);
  EXPECT_EQ(SMC_LogState(ctx, buffer), 0);
  EXPECT_TRUE(SMC_LogStart(ctx, buffer, 1));
}

TEST(LogBuffer, LosesNothingBetweenTwoThreads) {
  constexpr int kRecords = 99999; // beyond, some numbers have exponents
  SMC_LOG_BUFFER buffer{};
  ::stride::Ctx ctx{};
  ASSERT_TRUE(SMC_LogStart(ctx, buffer, 2));
  std::thread writer([&buffer] {
    ::stride::Ctx own{};
    for (int i = 0; i < kRecords;) {
      Values values{{static_cast<double>(i), static_cast<double>(-i), 0, 0, 0, 0}};
      if (SMC_LogPut(own, buffer, values))
        ++i;
      else
        std::this_thread::yield();
    }
    SMC_LogEnd(own, buffer);
  });
  std::string text;
  while (SMC_LogState(ctx, buffer) != 2) {
    const std::string more = take(ctx, buffer);
    text += more;
    if (more.empty())
      std::this_thread::yield();
  }
  writer.join();
  std::string expected;
  for (int i = 0; i < kRecords; ++i)
    expected += std::to_string(i) + ".0;" + std::to_string(-i) + ".0" + "\n";
  if (text != expected) { // 3 MB: only where they differ
    size_t at = 0;
    while (at < text.size() && at < expected.size() && text[at] == expected[at])
      ++at;
    FAIL() << text.substr(at < 40 ? 0 : at - 40, 80) << "\ninstead of\n"
           << expected.substr(at < 40 ? 0 : at - 40, 80);
  }
}

} // namespace
