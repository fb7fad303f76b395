#include "drivers/can/master/error_field.hpp"

#include "drivers/can/master/texts.hpp"

namespace stride::can {
namespace {

constexpr unsigned kMakersPart = 16; ///< Bits of an entry below what its maker puts there.

} // namespace

void ErrorField::begin() { step_ = Step::Register; }

void ErrorField::ask() {
  if (absent_)
    return;
  gone_ = false;
  if (step_ == Step::Idle)
    step_ = Step::Count;
  else
    again_ = true;
}

void ErrorField::gone() {
  said_ = 0;
  gone_ = step_ != Step::Idle;
}

ObjectWish ErrorField::wish() const {
  switch (step_) {
  case Step::Register:
    return {ObjectWish::Kind::Read, object::kErrorRegister};
  case Step::Count:
    return {ObjectWish::Kind::Read, {object::kErrorField, 0}};
  case Step::Newest:
    return {ObjectWish::Kind::Read, {object::kErrorField, 1}};
  default:
    return {};
  }
}

void ErrorField::answered(const ObjectAnswer &answer, bool missing, uint32_t node, const Told &told,
                          bus::News &news) {
  switch (step_) {
  case Step::Register:
    register_ = answer.done ? static_cast<uint8_t>(answer.value) : uint8_t{0};
    if (register_ != 0 || again_) {
      again_ = false;
      step_ = Step::Count;
    } else {
      end();
    }
    break;
  case Step::Count:
    counted(answer, missing, node, told, news);
    break;
  default: // Newest; the entry may have gone since they were counted
    if (answer.done)
      sayNewest(answer.value, node, told, news);
    end();
    break;
  }
}

void ErrorField::counted(const ObjectAnswer &answer, bool missing, uint32_t node, const Told &told,
                         bus::News &news) {
  absent_ = !answer.done && missing;
  count_ = answer.done ? static_cast<uint8_t>(answer.value) : uint8_t{0};
  if (count_ > 0) {
    step_ = Step::Newest;
    return;
  }
  sayRegister(node, told, news);
  end();
}

/// Of a node that has an error from the beginning and no list, nothing else would be known.
void ErrorField::sayRegister(uint32_t node, const Told &told, bus::News &news) {
  if (register_ != 0 && told.emcy.count() == 0)
    news.say("node ", node, " starts with an error: its error register (1001h) is ",
             HexText(register_, 2));
  register_ = 0;
}

/// What the node has told by itself is not said twice; but what its maker adds is in the list only.
void ErrorField::sayNewest(uint32_t newest, uint32_t node, const Told &told, bus::News &news) {
  register_ = 0;
  code_ = static_cast<uint16_t>(newest);
  const bool known =
      (told.emcy.has(code_) || told.errorCode == code_) && newest >> kMakersPart == 0;
  if (newest == said_ || known || newest == 0)
    return;
  said_ = gone_ ? 0 : newest;
  news.say("node ", node, ": the newest of ", uint32_t{count_}, count_ == 1 ? " error" : " errors",
           " in its list (1003h) is ", HexText(newest, 8), ": ", errorText(code_));
}

void ErrorField::end() {
  step_ = again_ && !absent_ ? Step::Count : Step::Idle;
  again_ = false;
}

} // namespace stride::can
