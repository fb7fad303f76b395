#include "tests/oracle/path/barrier_problem.hpp"

#include <algorithm>

namespace stride::oracle {

BandedSystem::BandedSystem(size_t size)
    : diagonal(size), first(size), second(size), rightSide(size) {}

void BandedSystem::clear() {
  for (std::vector<Exact> *part : {&diagonal, &first, &second, &rightSide})
    std::fill(part->begin(), part->end(), Exact(0));
}

bool BandedSystem::solve() {
  const size_t size = diagonal.size();
  // diagonal becomes D; first and second become the columns of L.
  for (size_t i = 0; i < size; ++i) {
    const Exact before = i >= 1 ? first[i - 1] : 0;
    const Exact before2 = i >= 2 ? second[i - 2] : 0;
    if (i >= 1)
      diagonal[i] -= before * before * diagonal[i - 1];
    if (i >= 2)
      diagonal[i] -= before2 * before2 * diagonal[i - 2];
    if (!(diagonal[i] > 0))
      return false;
    if (i + 1 < size) {
      const Exact bend = i >= 1 ? second[i - 1] * diagonal[i - 1] * before : 0;
      first[i] = (first[i] - bend) / diagonal[i];
    }
    if (i + 2 < size)
      second[i] /= diagonal[i];
    if (i >= 1)
      rightSide[i] -= before * rightSide[i - 1];
    if (i >= 2)
      rightSide[i] -= before2 * rightSide[i - 2];
  }
  for (size_t i = size; i-- > 0;) {
    rightSide[i] /= diagonal[i];
    if (i + 1 < size)
      rightSide[i] -= first[i] * rightSide[i + 1];
    if (i + 2 < size)
      rightSide[i] -= second[i] * rightSide[i + 2];
  }
  return true;
}

} // namespace stride::oracle
