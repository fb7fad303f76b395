// Any bytes as a program of SoftMotion 3's language and the subprograms that it calls, in pieces,
// with variables of all types.
#include "tests/unit/nc/nc_run.hpp"

#include <cstdlib>

using namespace stride;
using namespace stride::nc::test;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  // `|` begins a further program: sub1, sub2.
  std::vector<std::string> texts(1);
  for (size_t i = 0; i < size; ++i)
    if (data[i] == '|')
      texts.emplace_back();
    else
      texts.back().push_back(static_cast<char>(data[i]));
  double storage[40] = {1, 2, 3};
  char text[256] = "text";
  uint8_t flag = 1;
  Context context;
  context.variables = {variable("A", 22, storage),      variable("I", 1, storage + 8),
                       variable("B", 23, &flag),        variable("S", 24, text),
                       variable("M", 11, storage + 16), variable("R", 6, nullptr)};
  for (size_t i = 1; i < texts.size() && i < 4; ++i)
    context.files["sub" + std::to_string(i)] = texts[i];
  context.parentheses = size % 2 == 0;
  context.suppress = size % 3 == 0;
  context.most = 1500;
  const Ran ran = runText(texts[0], context);
  context.piece = 1 + size % 11;
  context.sentences = 3;
  storage[0] = 1;
  const Ran pieces = runText(texts[0], context);
  if (pieces.objects.size() > 4 * 1600)
    std::abort();
  for (const cnc::PathObject &object : ran.objects)
    if (!(object.length >= 0))
      std::abort();
  return 0;
}
