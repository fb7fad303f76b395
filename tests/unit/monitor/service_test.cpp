// The monitor's protocol.
#include "runtime/monitor/service.hpp"
#include "tests/unit/monitor/served_app.hpp"

#include <map>

namespace {

using namespace stride::monitor;
using nlohmann::json;
using ::testing::HasSubstr;

class Protocol : public stride::test::ServedApp {
protected:
  Protocol()
      : service([this](Service::ClientId id, const std::string &line) {
          lines[id].push_back(json::parse(line));
        }) {
    service.attach(0, {"handmade", &server, &tasks, [this] { return timeNs; }});
    service.addOperation("end", [this](const json &) {
      stopped = true;
      return json::object();
    });
  }

  json last(Service::ClientId client = 1) {
    json line = lines[client].empty() ? json() : lines[client].back();
    lines[client].clear();
    return line;
  }
  /// The answer of an operation that needs a cycle, or not.
  json ask(const std::string &request) {
    service.handle(1, request);
    run();
    service.poll(now += 1'000'000);
    return last();
  }
  json result(const std::string &request) {
    const json answer = ask(request);
    EXPECT_TRUE(answer.contains("result")) << answer.dump();
    return answer.value("result", json());
  }
  std::string refused(const std::string &request) {
    const json answer = ask(request);
    EXPECT_TRUE(answer.contains("error")) << answer.dump();
    const json error = answer.value("error", json::object());
    return error.value("code", "") + ": " + error.value("message", "");
  }

  Service service;
  std::map<Service::ClientId, std::vector<json>> lines;
  int64_t now = 1;
  bool stopped = false;
};

TEST_F(Protocol, Hello) {
  EXPECT_EQ(service.hello(), R"({"applications":["handmade"],"hello":"stride","version":2})");
}

TEST_F(Protocol, ReadsEveryKindOfValue) {
  const json answer = ask(R"({"id":"a","op":"read","names":
    ["PLC_PRG.flag","PLC_PRG.count","PLC_PRG.value","PLC_PRG.name","PLC_PRG.color","PLC_PRG.t"]})");
  EXPECT_EQ(answer["id"], "a");
  json values;
  for (const json &value : answer["result"]["values"])
    values.push_back(value["value"]);
  EXPECT_EQ(values.dump(), R"([true,1,0.1,"it's","green","T#1s500ms"])");
  EXPECT_EQ(answer["result"]["values"][5]["type"], "TIME");
  EXPECT_EQ(
      result(
          R"({"id":1,"op":"read","names":["PLC_PRG.name"],"literals":true})")["values"][0]["value"],
      "'it$'s'");
}

TEST_F(Protocol, WritesValuesAndLiterals) {
  result(R"({"op":"write","values":[{"name":"PLC_PRG.name","value":"a'$"},
    {"name":"PLC_PRG.t","literal":"T#2s"},{"name":"PLC_PRG.count","value":7},
    {"name":"PLC_PRG.value","value":2.5},{"name":"PLC_PRG.flag","value":true}]})");
  EXPECT_EQ(read("PLC_PRG.name"), "'a$'$$'");
  EXPECT_EQ(read("PLC_PRG.t"), "T#2s");
  EXPECT_EQ(read("PLC_PRG.count"), "8");
  EXPECT_EQ(read("PLC_PRG.value"), "2.6");
  EXPECT_EQ(read("PLC_PRG.flag"), "FALSE");
}

TEST_F(Protocol, Forces) {
  service.handle(1, R"({"id":1,"op":"force","values":[{"name":"PLC_PRG.count","value":7}]})");
  run();
  service.poll(++now);
  EXPECT_TRUE(last().is_null()); // the other task has not taken it yet
  tasks.runCycle(1, 0, 0);
  service.poll(++now);
  EXPECT_EQ(last(), json::parse(R"({"id":1,"result":{}})"));
  EXPECT_EQ(result(R"({"op":"forces"})").dump(),
            R"({"values":[{"literal":"7","name":"PLC_PRG.count"}]})");
  service.handle(1, R"({"op":"unforce","all":true})");
  EXPECT_EQ(result(R"({"op":"forces"})")["values"].size(), 0U);
  EXPECT_THAT(refused(R"({"op":"unforce","names":["total"]})"), HasSubstr("is not forced"));
}

TEST_F(Protocol, Lists) {
  const json page = result(R"({"op":"list","path":"PLC_PRG","offset":1,"limit":2})");
  EXPECT_EQ(page["total"], 13);
  EXPECT_EQ(page["entries"].size(), 2U);
  EXPECT_EQ(page["entries"][0]["path"], "PLC_PRG.value");
  EXPECT_EQ(result(R"({"op":"list"})")["entries"][1]["flags"].dump(), R"(["constant"])");
}

TEST_F(Protocol, Subscriptions) {
  service.handle(1, R"({"id":5,"op":"subscribe","names":["PLC_PRG.count"],"period":0.05})");
  EXPECT_EQ(last()["result"]["columns"][0]["name"], "PLC_PRG.count");
  std::string seen;
  for (int ms = 0; ms < 200; ms += 10) {
    run();
    service.poll(now += 10'000'000);
    for (const json &line : lines[1])
      seen += line["values"].dump() + "@" + line["time"].dump() + " ";
    lines[1].clear();
  }
  EXPECT_EQ(seen, "[1]@0.0 [7]@0.06 [12]@0.11 [17]@0.16 ");
  result(R"({"op":"unsubscribe","subscription":1})");
  EXPECT_THAT(refused(R"({"op":"unsubscribe","subscription":1})"), HasSubstr("no subscription 1"));
  const auto subscribe = [&] {
    service.handle(1, R"({"op":"subscribe","names":["total"]})");
    const json answer = last();
    return answer.contains("result") ? "accepted" : answer["error"]["code"].get<std::string>();
  };
  for (size_t i = 0; i < Service::kMostSubscriptions; ++i)
    EXPECT_EQ(subscribe(), "accepted");
  EXPECT_EQ(subscribe(), "too_many");
  service.forget(1);
  EXPECT_EQ(subscribe(), "accepted");
}

TEST_F(Protocol, TasksAndTheirFigures) {
  EXPECT_EQ(
      result(R"({"op":"tasks"})")["tasks"][0].dump(),
      R"({"interval_ns":10000000,"kind":"cyclic","name":"Fast","priority":1,"watchdog_ns":0})");
  run();
  EXPECT_EQ(result(R"({"op":"statistics"})")["tasks"][0]["cycles"], 2);
  const json state = result(R"({"op":"state"})");
  EXPECT_EQ(state["state"], "running");
  EXPECT_EQ(state["build"], "0000000000001234");
  write("PLC_PRG.divisor", "0");
  run();
  const json failed = result(R"({"op":"state"})");
  EXPECT_EQ(failed["state"], "stopped");
  EXPECT_THAT(failed["fault"].get<std::string>(), HasSubstr("division by zero"));
}

TEST_F(Protocol, Records) {
  EXPECT_THAT(refused(R"({"op":"record_read"})"), HasSubstr("no_recording"));
  result(R"({"op":"record","names":["PLC_PRG.count","PLC_PRG.flag"],"rows":4,"before":0.5,
             "trigger":{"name":"PLC_PRG.count","edge":"rising","threshold":"6"}})");
  EXPECT_THAT(refused(R"({"op":"record_read"})"), HasSubstr("not_done"));
  for (int i = 0; i < 10; ++i)
    run();
  EXPECT_EQ(result(R"({"op":"record_state"})").dump(),
            R"({"rows":4,"state":"done","taken":6,"trigger_row":2})");
  EXPECT_EQ(
      result(R"({"op":"record_read","from":1,"count":2})").dump(),
      R"({"header":"t,PLC_PRG.count,PLC_PRG.flag","lines":["0.04,5,1","0.05,6,0"],"rows":4})");
}

TEST_F(Protocol, AddedOperations) {
  result(R"({"op":"end"})");
  EXPECT_TRUE(stopped);
}

/// Answered when every task has taken it over.
TEST_F(Protocol, StopAndStart) {
  const auto others = [this] {
    for (uint32_t task = 1; task < tasks.count(); ++task)
      tasks.runCycle(task, timeNs, 0);
    service.poll(now += 1'000'000);
  };
  EXPECT_EQ(result(R"({"op":"state"})")["mode"], "RUN");
  const json count = result(R"({"op":"read","names":["PLC_PRG.count"]})")["values"];
  service.handle(1, R"({"id":7,"op":"stop"})");
  run();
  service.poll(now += 1'000'000);
  ASSERT_GT(tasks.count(), 1U);
  EXPECT_TRUE(last().is_null()) << "the other tasks have not";
  others();
  const json stopped = last();
  EXPECT_EQ(stopped["id"], 7);
  EXPECT_EQ(stopped["result"]["mode"], "STOP");
  EXPECT_EQ(stopped["result"]["state"], "running");
  run();
  const json later = result(R"({"op":"read","names":["PLC_PRG.count"]})")["values"];
  EXPECT_EQ(later[0]["value"].get<int>(), count[0]["value"].get<int>());
  EXPECT_EQ(result(R"({"op":"stop"})")["mode"], "STOP") << "again: at once";
  result(R"({"op":"write","values":[{"name":"PLC_PRG.count","value":40}]})");
  service.handle(1, R"({"op":"start"})");
  others();
  run();
  service.poll(now += 1'000'000);
  EXPECT_EQ(last()["result"]["mode"], "RUN");
  EXPECT_EQ(result(R"({"op":"read","names":["PLC_PRG.count"]})")["values"][0]["value"], 42)
      << "on from what was written in STOP";
  service.handle(1, R"({"op":"stop"})");
  service.poll(now += 1);
  service.poll(now += Service::kTimeoutNs + 1);
  EXPECT_EQ(last()["error"]["code"], "timeout");
  tasks.stop();
  EXPECT_THAT(refused(R"({"op":"start"})"), HasSubstr("gone"));
}

TEST_F(Protocol, BadRequests) {
  EXPECT_THAT(refused("{"), HasSubstr("bad_json"));
  EXPECT_THAT(refused("\xFF\xFE"), HasSubstr("bad_json"));
  EXPECT_THAT(refused("[]"), HasSubstr("a request is a JSON object"));
  EXPECT_THAT(refused(std::string(100000, '[')), HasSubstr("nested too deeply"));
  EXPECT_THAT(refused(R"({"id":{},"op":"state"})"), HasSubstr("'id' is a number"));
  EXPECT_THAT(refused(R"({"id":1})"), HasSubstr("'op' is missing"));
  EXPECT_THAT(refused(R"({"op":"raed"})"),
              HasSubstr("unknown_op: there is no operation 'raed'; did "
                        "you mean 'read'?"));
  EXPECT_THAT(refused(R"({"op":"read"})"), HasSubstr("'names' is a list"));
  EXPECT_THAT(refused(R"({"op":"read","names":[1]})"), HasSubstr("'names' is a list"));
  EXPECT_THAT(refused(R"({"op":"read","names":["totel"]})"), HasSubstr("did you mean 'total'?"));
  EXPECT_THAT(refused(R"({"op":"read","app":"handmad","names":["x"]})"),
              HasSubstr("did you mean 'handmade'?"));
  EXPECT_THAT(refused(R"({"op":"write","values":[{"name":"total"}]})"), HasSubstr("neither"));
  EXPECT_THAT(refused(R"({"op":"write","values":[{"name":"total","value":[]}]})"),
              HasSubstr("true, false, a number or a text"));
  EXPECT_THAT(refused(R"({"op":"list","limit":-1})"), HasSubstr("a whole number"));
  EXPECT_THAT(refused(R"({"op":"subscribe","names":["total"],"period":0.0001})"),
              HasSubstr("'period' is from"));
  EXPECT_THAT(refused(R"({"op":"record","names":["total"],"rows":1e99})"),
              HasSubstr("a whole number"));
}

TEST_F(Protocol, ATaskThatDoesNotRun) {
  service.handle(1, R"({"id":1,"op":"read","names":["total"]})");
  service.poll(now);
  EXPECT_TRUE(last().is_null());
  service.poll(now + Service::kTimeoutNs + 1);
  EXPECT_EQ(last()["error"]["code"], "timeout");
  for (size_t i = 0; i < Service::kMostPending; ++i)
    service.handle(2, R"({"op":"read","names":["total"]})");
  EXPECT_TRUE(lines[2].empty());
  service.handle(2, R"({"op":"read","names":["total"]})");
  EXPECT_EQ(last(2)["error"]["code"], "too_many");
}

TEST_F(Protocol, AnApplicationThatEnds) {
  service.handle(1, R"({"id":1,"op":"read","names":["total"]})");
  service.handle(2, R"({"id":1,"op":"subscribe","names":["total"]})");
  service.detach(0);
  EXPECT_EQ(last(1)["error"]["code"], "gone");
  EXPECT_EQ(last(2)["event"], "ended");
  EXPECT_THAT(refused(R"({"op":"read","names":["total"]})"),
              HasSubstr("does not run at the moment"));
  EXPECT_EQ(result(R"({"op":"state"})")["state"], "stopped");
}

} // namespace
