#include "tests/oracle/path/random_program.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace stride::oracle {

namespace {

/// What the sentences until now say.
struct ReaderState {
  std::vector<ProgramMove> moves;
  Point place{}, normal{0, 0, 1};
  double feed = 1;
};

Point normalOf(const std::string &code) {
  return code == "G17" ? Point{0, 0, 1} : code == "G18" ? Point{0, 1, 0} : Point{1, 0, 0};
}

void takeSentence(const std::string &line, ReaderState &state) {
  std::istringstream words(line);
  std::string code;
  words >> code;
  if (code.starts_with('N')) {
    code.clear();
    words >> code;
  }
  if (code.empty())
    return;
  if (code == "G17" || code == "G18" || code == "G19") {
    state.normal = normalOf(code);
    return;
  }
  if (code != "G0" && code != "G1" && code != "G2" && code != "G3" && code != "G92")
    throw std::runtime_error("not known here: " + line);
  Point end = state.place;
  Point centre = state.place;
  for (std::string word; words >> word;) {
    const double value = word.size() > 1 ? std::stod(word.substr(1)) : 0.0;
    const char letter = word.front();
    if (letter == 'F')
      state.feed = value;
    else if (letter >= 'X' && letter <= 'Z')
      end[static_cast<size_t>(letter - 'X')] = value;
    else if (letter >= 'I' && letter <= 'K')
      centre[static_cast<size_t>(letter - 'I')] += value;
  }
  const MoveKind kind = code == "G2"   ? MoveKind::Clockwise
                        : code == "G3" ? MoveKind::Counterclockwise
                                       : MoveKind::Line;
  if (code != "G92")
    state.moves.push_back({kind, state.place, end, centre, state.normal, state.feed, 0, 0});
  state.place = end;
}

} // namespace

std::vector<ProgramMove> movesOf(const std::string &file) {
  std::ifstream in(file);
  if (!in)
    throw std::runtime_error(file + " cannot be read");
  ReaderState state;
  std::string line;
  std::getline(in, line); // the program's name
  while (std::getline(in, line))
    takeSentence(line, state);
  return state.moves;
}

} // namespace stride::oracle
