#include "runtime/monitor/request_fields.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stride::monitor {

namespace {

using nlohmann::json;

[[noreturn]] void bad(const std::string &message) { throw ServiceError{"bad_request", message}; }

/// Deeper requests are not needed, and would be built on the way.
constexpr int kDeepest = 8;

} // namespace

json parseRequest(std::string_view line) {
  const auto deep = [](int depth, json::parse_event_t, const json &) {
    if (depth > kDeepest)
      bad("the request is nested too deeply");
    return true;
  };
  try {
    json request = json::parse(line, deep);
    if (!request.is_object())
      bad("a request is a JSON object, for example {\"id\":1,\"op\":\"state\"}");
    return request;
  } catch (const json::exception &error) {
    throw ServiceError{"bad_json", error.what()};
  }
}

json requestId(const json &request) {
  const auto id = request.find("id");
  if (id == request.end())
    return nullptr;
  if (!id->is_number() && !(id->is_string() && id->get_ref<const std::string &>().size() <= 200))
    bad("'id' is a number or a short text");
  return *id;
}

std::string textField(const json &request, const char *name) {
  const auto field = request.find(name);
  if (field == request.end())
    bad(fmt::format("'{}' is missing", name));
  if (!field->is_string())
    bad(fmt::format("'{}' is a text", name));
  return field->get<std::string>();
}

std::string textField(const json &request, const char *name, const char *otherwise) {
  return request.contains(name) ? textField(request, name) : otherwise;
}

std::vector<std::string> namesField(const json &request) {
  const auto field = request.find("names");
  if (field == request.end() || !field->is_array() || field->empty())
    bad("'names' is a list with the names of variables");
  std::vector<std::string> names;
  for (const json &name : *field) {
    if (!name.is_string())
      bad("'names' is a list with the names of variables");
    names.push_back(name.get<std::string>());
  }
  return names;
}

bool flagField(const json &request, const char *name) {
  const auto field = request.find(name);
  if (field == request.end())
    return false;
  if (!field->is_boolean())
    bad(fmt::format("'{}' is true or false", name));
  return field->get<bool>();
}

uint64_t countField(const json &request, const char *name, uint64_t otherwise, uint64_t most) {
  const auto field = request.find(name);
  if (field == request.end())
    return otherwise;
  if (!field->is_number_unsigned() || field->get<uint64_t>() > most)
    bad(fmt::format("'{}' is a whole number from 0 to {}", name, most));
  return field->get<uint64_t>();
}

double realField(const json &request, const char *name, double otherwise) {
  const auto field = request.find(name);
  if (field == request.end())
    return otherwise;
  if (!field->is_number() || !std::isfinite(field->get<double>()))
    bad(fmt::format("'{}' is a number", name));
  return field->get<double>();
}

double secondsOf(int64_t ns) { return static_cast<double>(ns) / 1e9; }

} // namespace stride::monitor
