#ifndef STRIDE_COMPILER_ASSETS_DXF_GROUPS_HPP
#define STRIDE_COMPILER_ASSETS_DXF_GROUPS_HPP
// The values of an entity.

#include "compiler/assets/dxf/drawing.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace stc::dxf {

inline constexpr auto kCorrectDrawing = "correct the drawing";

/// The groups of one entity.
class Groups {
public:
  Groups(const SourceFile &file, const Entity &entity, Faults &faults)
      : entity_(entity), faults_(faults) {
    Pairs pairs(file, entity.begin, entity.end, faults);
    while (const std::optional<Pair> pair = pairs.next())
      all_.push_back(*pair);
  }

  [[nodiscard]] const std::vector<Pair> &all() const { return all_; }
  [[nodiscard]] const Pair *find(int32_t code) const {
    const auto at = std::find_if(all_.begin(), all_.end(),
                                 [code](const Pair &pair) { return pair.code == code; });
    return at == all_.end() ? nullptr : &*at;
  }
  [[nodiscard]] double number(int32_t code, double missing) const {
    const Pair *pair = find(code);
    return pair == nullptr ? missing : numberOf(*pair, faults_);
  }
  /// A number that has to be there.
  [[nodiscard]] double number(int32_t code) const {
    if (find(code) == nullptr)
      fail(fmt::format("this {} has no group code {}", entity_.type, code), "a value is missing");
    return number(code, 0);
  }
  [[nodiscard]] int32_t integer(int32_t code, int32_t missing = 0) const {
    const Pair *pair = find(code);
    return pair == nullptr ? missing : integerOf(*pair, faults_);
  }
  [[nodiscard]] std::string text(int32_t code) const {
    const Pair *pair = find(code);
    return pair == nullptr ? std::string() : std::string(pair->value);
  }
  [[nodiscard]] Point place(int32_t code) const { return {number(code), number(code + 10)}; }

  /// All values of a group code.
  [[nodiscard]] std::vector<double> numbers(int32_t code) const {
    std::vector<double> result;
    for (const Pair &pair : all_)
      if (pair.code == code)
        result.push_back(numberOf(pair, faults_));
    return result;
  }

  void fail(const std::string &message, const std::string &label) const {
    faults_.report(entity_.span, message, label, kCorrectDrawing);
  }

private:
  const Entity &entity_;
  Faults &faults_;
  std::vector<Pair> all_;
};

} // namespace stc::dxf

#endif // STRIDE_COMPILER_ASSETS_DXF_GROUPS_HPP
