#include "drivers/sercos/master/parameter_transfer.hpp"

#include "drivers/sercos/plan/drive_settings.hpp"
#include "runtime/iec/math.h"

#include <algorithm>

namespace stride::sercos {
namespace {

using bus::ParameterAnswer;
using bus::ParameterForm;
using bus::ParameterRequest;
using Result = ParameterAnswer::Result;

/// What a refusal of the drive means for whoever has asked.
struct ResultRow {
  uint16_t code;
  Result result;
};
constexpr std::array<ResultRow, 11> kResults = {{
    {service_error::kNoIdn, Result::Unknown},
    {service_error::kNoName, Result::Unknown},
    {service_error::kNoUnit, Result::Unknown},
    {service_error::kNoMinimum, Result::Unknown},
    {service_error::kNoMaximum, Result::Unknown},
    {service_error::kReadOnly, Result::ReadOnly},
    {service_error::kProtectedNow, Result::Refused},
    {service_error::kBelowMinimum, Result::Refused},
    {service_error::kAboveMaximum, Result::Refused},
    {service_error::kInvalidData, Result::Refused},
    {service_error::kCyclic, Result::Refused},
}};

/// Commands of the moment: nobody wants them from a file.
constexpr std::array kMomentary = {
    idns::kVelocityCommand, idns::kAdditiveVelocity, idns::kPositionCommand,
    idns::kTorqueCommand,   idns::kAdditiveTorque,   idns::kControlWord,
    idns::kProbe1Enable,    idns::kProbe2Enable,     idns::kHomingEnable};

template <size_t N>
std::string_view copied(std::span<const uint8_t> bytes, std::array<char, N> &to) {
  const size_t count = std::min(bytes.size(), N);
  std::copy_n(bytes.begin(), count, to.begin());
  return {to.data(), count};
}

} // namespace

std::optional<ParameterPlace> placeOfParameter(int32_t number) {
  if (number < 0)
    return std::nullopt;
  const auto bits = static_cast<uint32_t>(number);
  ParameterPlace place;
  place.idn = static_cast<Idn>(bits);
  if (const uint32_t element = bits >> 16U & 7U; element != 0)
    place.element = static_cast<Element>(element);
  place.piece = bits >> 19U;
  return place;
}

void ParameterTransfer::start(const ParameterRequest &request) {
  request_ = request;
  answer_ = {};
  step_ = Step::Asked;
  if (request.kind == ParameterRequest::Kind::Describe) {
    if ((request.forms & formBit(ParameterForm::Number)) == 0 || request.number < 0)
      answer(Result::Unknown);
    return;
  }
  const auto place = placeOfParameter(request.number);
  const bool writes = request.kind == ParameterRequest::Kind::Write;
  if (place)
    place_ = *place;
  if (!place || (place->piece != 0 && request.form == ParameterForm::Bytes))
    answer(Result::Unknown);
  else if (writes && place->element != Element::Data)
    answer(Result::ReadOnly);
  else if (place->piece != 0)
    startPiece();
}

/// The pieces of a list that has been read, or will be written, need no transfer.
void ParameterTransfer::startPiece() {
  const size_t from = place_.piece >= 2 ? (place_.piece - 2) * 4 : 0;
  if (from + 4 > kMostInPieces) {
    answer(Result::Refused);
  } else if (request_.kind == ParameterRequest::Kind::Read) {
    if (place_.piece >= 2 && read_.isOf(place_))
      answerPiece();
  } else if (place_.piece >= 2) {
    if (!write_.isOf(place_))
      write_.clear();
    write_.idn = place_.idn;
    write_.element = place_.element;
    for (size_t i = 0; i < 4; ++i)
      write_.bytes[from + i] = static_cast<uint8_t>(request_.raw >> 8 * i);
    answer(Result::Done);
  } else {
    write_.size = std::min<size_t>(request_.raw, kMostInPieces);
    if (write_.size != request_.raw || (write_.size != 0 && !write_.isOf(place_)))
      answer(Result::Refused);
  }
}

void ParameterTransfer::answerPiece() {
  uint32_t word = 0;
  const size_t from = place_.piece >= 2 ? (place_.piece - 2) * 4 : 0;
  for (size_t i = 0; place_.piece >= 2 && i < 4 && from + i < read_.size; ++i)
    word |= uint32_t{read_.bytes[from + i]} << 8 * i;
  answerWith(place_.piece == 1 ? static_cast<int64_t>(read_.size) : static_cast<int64_t>(word));
}

void ParameterTransfer::answer(Result result) {
  answer_.result = result;
  step_ = Step::Answered;
}

void ParameterTransfer::answerWith(int64_t value) {
  answer_.raw = static_cast<uint32_t>(value);
  answer_.value = static_cast<double>(value);
  if (request_.form == ParameterForm::Bool)
    answer_.value = value != 0 ? 1.0 : 0.0;
  answer(Result::Done);
}

bool ParameterTransfer::poll(ParameterAnswer &answer) {
  if (step_ != Step::Answered)
    return false;
  answer = answer_;
  step_ = Step::Idle;
  return true;
}

void ParameterTransfer::cancel(ServiceChannel &channel) {
  if (step_ != Step::Idle && step_ != Step::Asked && step_ != Step::Answered)
    channel.cancel();
  step_ = Step::Idle;
}

void ParameterTransfer::clear() {
  if (step_ != Step::Idle)
    answer(Result::Failed);
  listCount_ = 0;
  next_ = 0;
  read_.element = write_.element = Element::None;
}

void ParameterTransfer::begin(ServiceChannel &channel) {
  if (request_.kind == ParameterRequest::Kind::Describe) {
    beginDescribe(channel);
  } else if (request_.kind == ParameterRequest::Kind::Write) {
    if (channel.read(place_.idn, Element::Attribute))
      step_ = Step::Measuring;
  } else if (channel.read(place_.idn, place_.element)) {
    step_ = Step::Reading;
  }
}

void ParameterTransfer::refused(const ServiceChannel &channel) {
  for (const ResultRow &row : kResults)
    if (row.code == channel.error()) {
      answer(row.result);
      return;
    }
  answer(Result::Failed);
}

void ParameterTransfer::finished(ServiceChannel &channel) {
  const bool done = channel.state() == ServiceChannel::State::Done;
  const bool optional = step_ == Step::Name || step_ == Step::Unit;
  if (!done && step_ == Step::List && channel.error() == service_error::kNoIdn) {
    channel.release();
    (void)channel.read(idns::kAllIdns, Element::Data);
    step_ = Step::AllIdns;
    return;
  }
  if (!done && !optional) {
    if (step_ != Step::Idle && step_ != Step::Answered)
      refused(channel);
    return;
  }
  switch (step_) {
  case Step::Reading:
    read(channel);
    break;
  case Step::Measuring:
    write(channel);
    break;
  case Step::Writing:
    answer(Result::Done);
    break;
  case Step::List:
  case Step::AllIdns:
    listRead(channel);
    break;
  case Step::Attribute:
  case Step::Name:
  case Step::Unit:
    described(channel);
    break;
  default:
    break;
  }
}

void ParameterTransfer::read(const ServiceChannel &channel) {
  const std::span<const uint8_t> bytes = channel.bytes();
  if (request_.form == ParameterForm::Bytes) {
    answer_.bytes.assign(bytes);
    answer(Result::Done);
    return;
  }
  const bool isText = place_.element == Element::Name || place_.element == Element::Unit;
  const bool isValue = place_.element != Element::Idn && place_.element != Element::Attribute;
  const bool isList = isText || (isValue && channel.attribute().list);
  if (isList != (place_.piece != 0)) {
    answer(Result::Unknown); // it is no number, or nothing else
    return;
  }
  if (place_.piece != 0) {
    if (bytes.size() > kMostInPieces) {
      answer(Result::Failed);
      return;
    }
    std::copy(bytes.begin(), bytes.end(), read_.bytes.begin());
    read_.size = bytes.size();
    read_.idn = place_.idn;
    read_.element = place_.element;
    answerPiece();
    return;
  }
  answerWith(channel.number());
}

bool ParameterTransfer::encode(const Attribute &attribute, std::span<const uint8_t> &bytes) {
  if (request_.form == ParameterForm::Bytes) {
    bytes = request_.bytes.bytes();
    return attribute.list || bytes.size() == attribute.bytes;
  }
  if (place_.piece != 0) {
    bytes = std::span<const uint8_t>(write_.bytes).first(write_.size);
    write_.element = Element::None;
    return attribute.list;
  }
  if (attribute.list || !encodeNumber(attribute))
    return false;
  bytes = std::span<const uint8_t>(number_).first(attribute.bytes);
  return true;
}

bool ParameterTransfer::encodeNumber(const Attribute &attribute) {
  const size_t count = attribute.bytes;
  if (count > number_.size())
    return false;
  uint64_t word = request_.raw;
  if (request_.form == ParameterForm::Raw) {
    const uint32_t above = count >= 4 ? 0 : request_.raw >> (8 * count - 1);
    // What is cut off is nothing, or a sign.
    if (above >> 1U != 0 && above != UINT32_MAX >> (8 * count - 1))
      return false;
  } else {
    const double whole = stride::floor(request_.value + 0.5);
    const double range = stride::pow(2.0, 8.0 * static_cast<double>(count));
    const bool isSigned = attribute.display == Display::Signed;
    if (!(whole >= (isSigned ? -range / 2 : 0) && whole <= (isSigned ? range / 2 : range) - 1))
      return false;
    word = whole < 0 ? static_cast<uint64_t>(static_cast<int64_t>(whole))
                     : static_cast<uint64_t>(whole);
    if (request_.form == ParameterForm::Bool)
      word = request_.value != 0 ? 1 : 0;
  }
  for (size_t i = 0; i < count; ++i)
    number_[i] = static_cast<uint8_t>(word >> 8 * i);
  return true;
}

void ParameterTransfer::write(ServiceChannel &channel) {
  std::span<const uint8_t> bytes;
  const Attribute attribute = channel.attribute();
  if (!encode(attribute, bytes)) {
    answer(attribute.list && request_.form != ParameterForm::Bytes ? Result::Unknown
                                                                   : Result::Refused);
    return;
  }
  channel.release();
  if (channel.write(place_.idn, bytes))
    step_ = Step::Writing;
}

// The list of a drive is S-0-0192: what there is to be stored. Only numbers of it are told that can
// be set, and that are not the driver's own matter.

bool ParameterTransfer::isTold(Idn idn, const Attribute &attribute) const {
  return !attribute.list && !attribute.command && attribute.protection != protect::kAlways &&
         !isOwnedByDriver(idn) && !told_.carries(idn) &&
         std::find(kMomentary.begin(), kMomentary.end(), idn) == kMomentary.end();
}

void ParameterTransfer::beginDescribe(ServiceChannel &channel) {
  if (request_.number == next_ && next_ != 0)
    nextListed(channel);
  else if (channel.read(idns::kStoreList, Element::Data))
    step_ = Step::List;
}

void ParameterTransfer::listRead(ServiceChannel &channel) {
  const std::span<const uint8_t> bytes = channel.bytes();
  listCount_ = std::min(bytes.size() / 2, listed_.size());
  for (size_t i = 0; i < listCount_; ++i)
    listed_[i] = static_cast<Idn>(bytes[2 * i] | bytes[2 * i + 1] << 8U);
  listPlace_ = 0;
  next_ = 0;
  nextListed(channel);
}

void ParameterTransfer::nextListed(ServiceChannel &channel) {
  if (listPlace_ >= listCount_) {
    next_ = 0;
    answer(Result::Unknown);
    return;
  }
  channel.release();
  if (channel.read(listed_[listPlace_], Element::Attribute))
    step_ = Step::Attribute;
}

void ParameterTransfer::described(ServiceChannel &channel) {
  const bool done = channel.state() == ServiceChannel::State::Done;
  const Idn idn = listed_[listPlace_];
  if (step_ == Step::Attribute) {
    const Attribute attribute = channel.attribute();
    const bool told = isTold(idn, attribute);
    if (!told || next_ < request_.number) {
      next_ += told ? 1 : 0;
      ++listPlace_;
      nextListed(channel);
      return;
    }
    answer_.number = idn;
    answer_.type = ParameterAnswer::Type::Whole;
    answer_.writable = true;
    channel.release();
    if (channel.read(idn, Element::Name))
      step_ = Step::Name;
  } else if (step_ == Step::Name) {
    answer_.name = done ? copied(channel.bytes(), name_) : std::string_view();
    channel.release();
    if (channel.read(idn, Element::Unit))
      step_ = Step::Unit;
  } else {
    answer_.unit = done ? copied(channel.bytes(), unit_) : std::string_view();
    ++listPlace_;
    ++next_;
    answer(Result::Done);
  }
}

} // namespace stride::sercos
