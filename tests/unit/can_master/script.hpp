// Conversations in hexadecimal: what the master must say, and what a node answers.
#ifndef STRIDE_TESTS_UNIT_CAN_MASTER_SCRIPT_HPP
#define STRIDE_TESTS_UNIT_CAN_MASTER_SCRIPT_HPP

#include "drivers/can/port/frame.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace stride::can::test {

/// "605#2F60600008000000" or "705#R": identifier, bytes.
inline std::string text(const Frame &frame) {
  char buffer[8];
  std::snprintf(buffer, sizeof buffer, "%03X#", frame.id);
  std::string result = buffer;
  if (frame.remote)
    return result + "R";
  for (const uint8_t byte : frame.bytes()) {
    std::snprintf(buffer, sizeof buffer, "%02X", byte);
    result += buffer;
  }
  return result;
}

/// The frame of such a text; blanks between bytes are nothing.
inline Frame frame(const std::string &text) {
  Frame result;
  const size_t hash = text.find('#');
  result.id = static_cast<uint16_t>(std::strtoul(text.substr(0, hash).c_str(), nullptr, 16));
  std::string digits;
  for (const char c : text.substr(hash + 1))
    if (c == 'R')
      result.remote = true;
    else if (c != ' ')
      digits += c;
  for (size_t i = 0; i + 1 < digits.size() && result.length < 8; i += 2)
    result.data[result.length++] =
        static_cast<uint8_t>(std::strtoul(digits.substr(i, 2).c_str(), nullptr, 16));
  return result;
}

/// A script's lines, without what is empty.
inline std::vector<std::string> lines(const std::string &script) {
  std::vector<std::string> result;
  std::istringstream stream(script);
  for (std::string line; std::getline(stream, line);) {
    const size_t first = line.find_first_not_of(' ');
    if (first != std::string::npos)
      result.push_back(line.substr(first));
  }
  return result;
}

} // namespace stride::can::test

#endif
