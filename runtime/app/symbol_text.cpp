#include "runtime/app/symbol_text.hpp"

#include "runtime/app/error.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

namespace stride::app {

class DescribedApplication::Reader {
public:
  Reader(DescribedApplication &to, const SymbolLines &from) : to_(to), from_(from) {
    if (from.text == nullptr || (from.numbers == nullptr && from.numberLists != 0))
      damaged();
    to_.text_.assign(from.text, from.text + from.length);
    reserve();
  }

  void run() {
    const auto end = to_.text_.end();
    for (auto begin = to_.text_.begin(); begin != end; ++line_) {
      const auto stop = std::find(begin, end, '\n');
      if (stop == end)
        damaged();
      rest_ = &*begin + 1;
      end_ = &*stop;
      *stop = 0;
      line(*begin);
      if (rest_ != end_)
        damaged();
      begin = stop + 1;
    }
    if (list_ != from_.numberLists || next_ != 0)
      damaged();
  }

private:
  [[noreturn]] void damaged() const {
    throw Error("its description is damaged (line " + std::to_string(line_ + 1) +
                " of its symbols); build it again");
  }

  /// The long lists are not moved while they grow.
  void reserve() {
    size_t types = 0;
    size_t members = 0;
    char before = '\n';
    for (const char c : to_.text_) {
      types += before == '\n' && c == 'T' ? 1 : 0;
      members += before == '\n' && c == 'M' ? 1 : 0;
      before = c;
    }
    to_.types_.reserve(types);
    to_.members_.reserve(members);
  }

  void line(char kind) {
    switch (kind) {
    case 'T':
      return type();
    case 'M':
      return member();
    case 'E':
      return enumerator();
    case 'R':
      return root();
    default:
      damaged();
    }
  }

  void type() {
    TypeDesc &type = to_.types_.emplace_back();
    type.flags = number<uint32_t>(0);
    type.name = name();
    type.layoutHash = number<uint64_t>(0, 16);
    type.element = number<uint32_t>(kNoIndex);
    type.lowerBound = number<int64_t>(0);
    type.elementCount = number<uint64_t>(0);
    type.stringLength = number<uint32_t>(0);
    type.typeId = number<uint32_t>(0);
    type.renamedFrom = text();
    type.kind = Kind{measure32()};
    type.size = measure();
    type.align = measure32();
    const bool isEnum = type.kind == Kind::Enum;
    type.firstMember =
        static_cast<uint32_t>(isEnum ? to_.enumerators_.size() : to_.members_.size());
  }

  void member() {
    MemberDesc &member = to_.members_.emplace_back();
    member.flags = flags();
    member.name = name();
    member.type = number<uint32_t>(kNoIndex);
    member.renamedFrom = text();
    member.offset = measure();
    if (to_.types_.empty() || to_.types_.back().kind == Kind::Enum)
      damaged();
    ++to_.types_.back().memberCount;
  }

  void enumerator() {
    EnumeratorDesc &enumerator = to_.enumerators_.emplace_back();
    if (*column() != 0)
      damaged();
    enumerator.name = name();
    enumerator.value = number<int64_t>(0);
    if (to_.types_.empty() || to_.types_.back().kind != Kind::Enum)
      damaged();
    ++to_.types_.back().memberCount;
  }

  void root() {
    RootDesc &root = to_.roots_.emplace_back();
    root.flags = flags();
    root.name = name();
    root.type = number<uint32_t>(kNoIndex);
    root.list = text();
    root.task = number<uint32_t>(kNoIndex);
    root.renamedFrom = text();
    root.offset = measure();
  }

  /// The next column, which ends with 0.
  char *column() {
    char *const begin = rest_;
    char *const tab = std::find(begin, end_, '\t');
    rest_ = tab == end_ ? end_ : tab + 1;
    *tab = 0;
    return begin;
  }
  const char *name() {
    const char *const name = column();
    if (*name == 0)
      damaged();
    return name;
  }
  const char *text() {
    const char *const text = column();
    return *text == 0 ? nullptr : text;
  }
  template <class T> T number(T ofNothing, int base = 10) {
    const std::string_view text = column();
    if (text.empty())
      return ofNothing;
    T value{};
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    if (error != std::errc() || stop != text.data() + text.size())
      damaged();
    return value;
  }

  uint32_t flags() {
    uint32_t flags = 0;
    char before = 0;
    for (const char *at = column(); *at != 0; before = *at++) {
      const char *const letter = std::strchr(kSymbolFlagLetters, *at);
      if (letter != nullptr && *at != '.')
        flags |= 1U << static_cast<unsigned>(letter - kSymbolFlagLetters);
      else if (before == 's' && *at >= '0' && *at <= '2')
        flags |= static_cast<unsigned>(*at - '0') << kSymAreaShift;
      else if (before == 'b' && *at >= '0' && *at <= '7')
        flags |= static_cast<unsigned>(*at - '0') << kSymBitShift;
      else
        damaged();
    }
    return flags;
  }

  /// The next number of the C++ compiler.
  uint64_t measure() {
    if (list_ == from_.numberLists || from_.numbers[list_].count == 0)
      damaged();
    const SymbolNumbers &list = from_.numbers[list_];
    const uint64_t value = list.values[next_];
    if (++next_ == list.count) {
      ++list_;
      next_ = 0;
    }
    return value;
  }
  uint32_t measure32() {
    const uint64_t value = measure();
    if (value > std::numeric_limits<uint32_t>::max())
      damaged();
    return static_cast<uint32_t>(value);
  }

  DescribedApplication &to_;
  const SymbolLines &from_;
  char *rest_ = nullptr; // columns of this line
  char *end_ = nullptr;
  size_t line_ = 0;
  uint32_t list_ = 0; // the next number
  uint64_t next_ = 0;
};

DescribedApplication::DescribedApplication(const StrideAppV1 &given) : description_(given) {
  if (given.symbols == nullptr)
    return;
  Reader(*this, *given.symbols).run();
  description_.symbols = nullptr;
  description_.types = types_.data();
  description_.members = members_.data();
  description_.enumerators = enumerators_.data();
  description_.roots = roots_.data();
  description_.typeCount = static_cast<uint32_t>(types_.size());
  description_.memberCount = static_cast<uint32_t>(members_.size());
  description_.enumeratorCount = static_cast<uint32_t>(enumerators_.size());
  description_.rootCount = static_cast<uint32_t>(roots_.size());
}

} // namespace stride::app
