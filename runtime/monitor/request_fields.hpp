// The fields of a request, checked.
#ifndef STRIDE_RUNTIME_MONITOR_REQUEST_FIELDS_HPP
#define STRIDE_RUNTIME_MONITOR_REQUEST_FIELDS_HPP

#include "runtime/monitor/service.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stride::monitor {

/// The object in a line. Throws ServiceError, as all of these do.
nlohmann::json parseRequest(std::string_view line);
/// Its `id`: a number or a text; null without one.
nlohmann::json requestId(const nlohmann::json &request);

std::string textField(const nlohmann::json &request, const char *name);
std::string textField(const nlohmann::json &request, const char *name, const char *otherwise);
/// A list of texts with at least one in it.
std::vector<std::string> namesField(const nlohmann::json &request);
bool flagField(const nlohmann::json &request, const char *name);
/// An integer from 0 to `most`.
uint64_t countField(const nlohmann::json &request, const char *name, uint64_t otherwise,
                    uint64_t most);
double realField(const nlohmann::json &request, const char *name, double otherwise);

/// As `time` in answers.
double secondsOf(int64_t ns);

} // namespace stride::monitor

#endif
