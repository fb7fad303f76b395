#include "tests/bench/st/twin.h"

#include <string.h>

namespace {

constexpr size_t kMax = 120;
using Text = char[kMax + 1];

void append(Text &to, const char *text) {
  const size_t have = strlen(to);
  size_t n = strlen(text);
  n = n < kMax - have ? n : kMax - have;
  memmove(to + have, text, n);
  to[have + n] = 0;
}

void keepRight(Text &text, size_t n) {
  const size_t length = strlen(text);
  if (n < length)
    memmove(text, text + length - n, n + 1);
}

void insert(Text &text, const char *what, size_t at) {
  const size_t length = strlen(text);
  const size_t n = strlen(what);
  const size_t rest = length - at < kMax - at - n ? length - at : kMax - at - n;
  memmove(text + at + n, text + at, rest);
  memcpy(text + at, what, n);
  text[at + n + rest] = 0;
}

int position(const char *text, const char *what) {
  const char *const found = strstr(text, what);
  return found == nullptr ? 0 : static_cast<int>(found - text) + 1;
}

struct Plc {
  Text line;
  Text word;
  Text head;
  Text tail;
  int32_t total;
  char names[8][13];
  int64_t checksum;

  void init() {
    static const char *const kNames[] = {"alpha",   "beta", "gamma", "delta",
                                         "epsilon", "zeta", "eta",   "theta"};
    for (int i = 0; i < 8; ++i)
      strcpy(names[i], kNames[i]);
  }

  void cycle(int64_t) {
    line[0] = 0;
    for (int i = 0; i < 16; ++i) {
      strcpy(word, names[i % 8]);
      append(line, word);
      append(line, ";");
      if (strlen(line) > 80)
        keepRight(line, 40);
      if (strcmp(word, "gamma") == 0)
        insert(line, "<g>", 3);
    }
    int n = 0;
    for (int at = position(line, ";"); at > 0; at = position(line, ";")) {
      const size_t before = static_cast<size_t>(at) - 1;
      memcpy(head, line, before);
      head[before] = 0;
      strcpy(tail, line + at);
      strcpy(line, tail);
      ++n;
      total += static_cast<int32_t>(strlen(head));
      if (strcmp(head, "epsilon") < 0)
        total += 3;
    }
    static const char kCommand[] = "set speed = 100 %";
    memcpy(head, kCommand, 4);
    strcpy(head + 4, "torque");
    strcat(head, kCommand + 9);
    head[strlen(head) - 2] = 0;
    total += position(head, "100") + n;
    checksum += total;
  }
};

} // namespace

STRIDE_TWIN(Plc)
