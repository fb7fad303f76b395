// The recorder: rows before and after a trigger.
#include "tests/unit/monitor/served_app.hpp"

namespace {

using namespace stride::monitor;
using ::testing::HasSubstr;

class Recording : public stride::test::ServedApp {
protected:
  std::shared_ptr<Recorder> record(size_t rows, double before,
                                   std::optional<TriggerSettings> trigger) {
    RecorderSettings settings;
    settings.names = {"PLC_PRG.count"};
    settings.rows = rows;
    settings.before = before;
    settings.trigger = std::move(trigger);
    auto recorder = std::make_shared<Recorder>(symbols, settings);
    server.setRecorder(recorder);
    return recorder;
  }
  static std::string rowsOf(const Recorder &recorder) {
    std::string text;
    for (size_t i = 0; i < recorder.rows(); ++i) {
      recorder.appendLine(i, text);
      text += ' ';
    }
    return text;
  }
};

TEST_F(Recording, AtOnce) {
  const auto recorder = record(3, 0.5, std::nullopt);
  EXPECT_EQ(recorder->header(), "t,PLC_PRG.count");
  run();
  run();
  EXPECT_EQ(recorder->state(), Recorder::State::Triggered);
  EXPECT_EQ(recorder->rows(), 0U);
  run();
  run();
  EXPECT_EQ(recorder->state(), Recorder::State::Done);
  EXPECT_EQ(rowsOf(*recorder), "0,1 0.01,2 0.02,3 ");
  EXPECT_FALSE(recorder->triggerRow());
}

TEST_F(Recording, BeforeAndBehindARisingEdge) {
  const auto recorder = record(4, 0.5, TriggerSettings{"PLC_PRG.count", TriggerEdge::Rising, "10"});
  for (int i = 0; i < 9; ++i)
    run();
  EXPECT_EQ(recorder->state(), Recorder::State::Armed);
  for (int i = 0; i < 5; ++i)
    run();
  EXPECT_EQ(recorder->state(), Recorder::State::Done);
  EXPECT_EQ(rowsOf(*recorder), "0.07,8 0.08,9 0.09,10 0.1,11 ");
  EXPECT_EQ(recorder->triggerRow(), 2U);
}

TEST_F(Recording, EdgesAndLevels) {
  // flag is TRUE in every other row, beginning with the first one.
  const auto firstOf = [&](TriggerEdge edge) {
    const auto recorder = record(1, 0.0, TriggerSettings{"PLC_PRG.flag", edge, ""});
    write("PLC_PRG.count", "0");
    write("PLC_PRG.flag", "FALSE");
    for (int i = 0; i < 4; ++i)
      run();
    std::string text;
    recorder->appendLine(0, text);
    return text.substr(text.find(',') + 1);
  };
  EXPECT_EQ(firstOf(TriggerEdge::High), "1");
  EXPECT_EQ(firstOf(TriggerEdge::Falling), "2");
  EXPECT_EQ(firstOf(TriggerEdge::Low), "2");
  EXPECT_EQ(firstOf(TriggerEdge::Rising), "3");
}

TEST_F(Recording, ATriggerBeforeTheRingIsFull) {
  const auto recorder = record(10, 0.9, TriggerSettings{"PLC_PRG.count", TriggerEdge::High, "2"});
  run();
  run();
  EXPECT_EQ(recorder->state(), Recorder::State::Done);
  EXPECT_EQ(rowsOf(*recorder), "0,1 0.01,2 ");
  EXPECT_EQ(recorder->triggerRow(), 1U);
}

TEST_F(Recording, Stopped) {
  const auto recorder =
      record(100, 0.5, TriggerSettings{"PLC_PRG.count", TriggerEdge::Rising, "1000"});
  run();
  run();
  recorder->stop();
  EXPECT_NE(recorder->state(), Recorder::State::Done);
  run();
  EXPECT_EQ(rowsOf(*recorder), "0,1 0.01,2 ");
  EXPECT_FALSE(recorder->triggerRow());
}

TEST_F(Recording, ANewOneEndsTheOld) {
  const auto old = record(100, 0, std::nullopt);
  run();
  const auto fresh = record(1, 0, std::nullopt);
  run();
  run();
  EXPECT_EQ(old->taken(), 1U);
  EXPECT_EQ(fresh->state(), Recorder::State::Done);
}

TEST_F(Recording, Mistakes) {
  const auto mistake = [&](RecorderSettings settings) {
    return errorOf([&] { Recorder recorder(symbols, settings); });
  };
  RecorderSettings good;
  good.names = {"total"};
  RecorderSettings bad = good;
  bad.rows = 0;
  EXPECT_THAT(mistake(bad), HasSubstr("0 rows is not possible"));
  bad.rows = size_t{1} << 40;
  EXPECT_THAT(mistake(bad), HasSubstr("leave room for 1 to"));
  bad = good;
  bad.before = 1.5;
  EXPECT_THAT(mistake(bad), HasSubstr("from 0 to 1"));
  bad = good;
  bad.trigger = TriggerSettings{"total", TriggerEdge::Rising, ""};
  EXPECT_THAT(mistake(bad), HasSubstr("give a threshold"));
  bad.trigger = TriggerSettings{"PLC_PRG.flag", TriggerEdge::Rising, "1"};
  EXPECT_THAT(mistake(bad), HasSubstr("has no threshold"));
  bad.names = {"totel"};
  EXPECT_THAT(mistake(bad), HasSubstr("did you mean 'total'?"));
}

} // namespace
