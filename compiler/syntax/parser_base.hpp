#ifndef STRIDE_COMPILER_SYNTAX_PARSER_BASE_HPP
#define STRIDE_COMPILER_SYNTAX_PARSER_BASE_HPP
// What the generated parser and its contexts derive from (`superClass` and `contextSuperClass` of
// StParser.g4). Generated code names members of ANTLR's Parser; it finds those of the same name
// here before them, which are inlined and take no memory of the heap. Internal to compiler/syntax:
// includes ANTLR.

#include "compiler/syntax/token.hpp"

#include "antlr4-runtime.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace stc {

/// A unit's tokens; the last one is of type Token::kEnd and lies where the text goes on.
class UnitStream final : public antlr4::TokenStream {
public:
  void reset(std::vector<Token> &tokens) {
    tokens_ = &tokens;
    place_ = 0;
  }
  void rewind() { place_ = 0; }
  [[nodiscard]] Token &current() { return (*tokens_)[place_]; }
  [[nodiscard]] Token &token(size_t index) { return (*tokens_)[index]; }
  void advance() {
    if (place_ + 1 < tokens_->size())
      ++place_;
  }

  void consume() override { advance(); }
  size_t LA(ssize_t i) override { return LT(i)->getType(); }
  Token *LT(ssize_t k) override {
    if (k == 1)
      return tokens_->data() + place_;
    const auto at = static_cast<ssize_t>(place_) + (k > 0 ? k - 1 : k);
    if (at < 0)
      return nullptr;
    return tokens_->data() + std::min(static_cast<size_t>(at), tokens_->size() - 1);
  }
  ssize_t mark() override { return 0; }
  void release(ssize_t) override {}
  size_t index() override { return place_; }
  void seek(size_t index) override { place_ = index; }
  size_t size() override { return tokens_->size(); }
  std::string getSourceName() const override { return {}; }
  antlr4::Token *get(size_t index) const override { return tokens_->data() + index; }
  antlr4::TokenSource *getTokenSource() const override { return nullptr; }
  std::string getText(const antlr4::misc::Interval &) override { return {}; }
  std::string getText() override { return {}; }
  std::string getText(antlr4::RuleContext *) override { return {}; }
  std::string getText(antlr4::Token *, antlr4::Token *) override { return {}; }

private:
  std::vector<Token> *tokens_ = nullptr;
  size_t place_ = 0;
};

namespace grammar {

// Names that generated code uses, not ours.
// NOLINTBEGIN(readability-identifier-naming)

/// The memory of one unit's parse tree, and of the next one's after it.
class UnitMemory {
public:
  void *allocate(size_t bytes) {
    bytes = (bytes + kAlign - 1) & ~(kAlign - 1);
    if (static_cast<size_t>(end_ - cursor_) < bytes)
      nextBlock(bytes);
    return std::exchange(cursor_, cursor_ + bytes);
  }
  /// Nothing that it has given is used any more.
  void reset() {
    used_ = 0;
    cursor_ = end_ = nullptr;
  }

  /// As ANTLR's tracker does it.
  template <class T, class... Args> T *createInstance(Args &&...args) {
    static_assert(alignof(T) <= kAlign);
    return ::new (allocate(sizeof(T))) T(std::forward<Args>(args)...);
  }

private:
  struct Block {
    std::unique_ptr<std::byte[]> bytes;
    size_t size;
  };

  void nextBlock(size_t least) {
    while (used_ < blocks_.size() && blocks_[used_].size < least)
      ++used_;
    if (used_ == blocks_.size()) {
      const size_t size = std::max(least, kBlock);
      blocks_.push_back({std::make_unique_for_overwrite<std::byte[]>(size), size});
    }
    cursor_ = blocks_[used_].bytes.get();
    end_ = cursor_ + blocks_[used_].size;
    ++used_;
  }

  static constexpr size_t kAlign = 16;
  static constexpr size_t kBlock = size_t{32} * 1024;
  std::vector<Block> blocks_;
  size_t used_ = 0; ///< blocks
  std::byte *cursor_ = nullptr;
  std::byte *end_ = nullptr;
};

class ContextBase;

/// The contexts below one, in the unit's memory.
class ContextList {
public:
  [[nodiscard]] size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] ContextBase *operator[](size_t i) const { return data_[i]; }
  [[nodiscard]] ContextBase *back() const { return data_[size_ - 1]; }
  void add(ContextBase *one, UnitMemory &memory) {
    if (size_ == capacity_)
      grow(memory);
    data_[size_++] = one;
  }

private:
  void grow(UnitMemory &memory) {
    capacity_ = std::max(4U, 2 * capacity_);
    auto *larger = static_cast<ContextBase **>(memory.allocate(capacity_ * sizeof(ContextBase *)));
    std::copy_n(data_, size_, larger);
    data_ = larger;
  }

  ContextBase **data_ = nullptr;
  uint32_t size_ = 0;
  uint32_t capacity_ = 0;
};

/// That a rule has failed. Generated code keeps and gives on the exception, which nobody looks at.
class Failure {
public:
  Failure &operator=(const std::exception_ptr &) {
    failed_ = true;
    return *this;
  }
  /// Generated code asks where it has caught it.
  operator std::exception_ptr() const { return std::current_exception(); } // NOLINT: no cast there
  [[nodiscard]] bool failed() const { return failed_; }

private:
  bool failed_ = false;
};

/// A node of the parse tree. It is never destroyed: what ANTLR's own class would have to free,
/// `children` and `exception`, stays empty, and these take its place. So ANTLR's functions that
/// look for children find none.
class ContextBase : public antlr4::ParserRuleContext {
public:
  using antlr4::ParserRuleContext::ParserRuleContext;
  ContextList children;
  Failure exception;
};

class ParserBase : public antlr4::Parser {
public:
  explicit ParserBase(antlr4::TokenStream *stream)
      : antlr4::Parser(stream), _input(static_cast<UnitStream *>(stream)) {}

  /// Begins the unit again. With a strategy errors are reported; without one (null) the first
  /// error throws ParseCancellationException.
  void begin(antlr4::ANTLRErrorStrategy *strategy) {
    _input->rewind();
    _tracker.reset();
    _ctx = nullptr;
    expected_ = 0;
    _errHandler.use(strategy);
    if (strategy != nullptr)
      strategy->reset(this);
  }
  [[nodiscard]] ContextBase *context() const { return _ctx; }
  [[nodiscard]] antlr4::ParserRuleContext *getContext() final { return _ctx; }
  [[nodiscard]] UnitStream &stream() { return *_input; }
  /// The token type that the failed match() wanted; 0 when it was one of a set.
  [[nodiscard]] uint16_t expected() const { return expected_; }
  void clearExpected() { expected_ = 0; }

  antlr4::Token *match(size_t type) final {
    Token &token = _input->current();
    if (token.getType() == type) {
      _errHandler.reportMatch(this);
      _input->advance();
      return &token;
    }
    expected_ = type == Token::EOF ? Token::kEnd : static_cast<uint16_t>(type);
    return _errHandler.recoverInline(this);
  }
  antlr4::Token *consume() final {
    Token &token = _input->current();
    _input->advance();
    expected_ = 0;
    return &token;
  }
  void enterRule(antlr4::ParserRuleContext *context, size_t state, size_t) final {
    state_ = state;
    ContextBase *around = _ctx;
    _ctx = static_cast<ContextBase *>(context);
    _ctx->start = &_input->current();
    if (around != nullptr)
      around->children.add(_ctx, _tracker);
  }
  void exitRule() {
    _ctx->stop = _input->LT(-1);
    state_ = _ctx->invokingState;
    _ctx = static_cast<ContextBase *>(_ctx->parent);
  }
  void enterOuterAlt(antlr4::ParserRuleContext *, size_t) final {}
  void setState(size_t state) { state_ = state; }
  [[nodiscard]] size_t getState() const final { return state_; }

protected:
  /// What generated code does with errors.
  class Errors {
  public:
    void use(antlr4::ANTLRErrorStrategy *strategy) { strategy_ = strategy; }
    Errors *operator->() { return this; }
    void sync(antlr4::Parser *parser) {
      if (strategy_ != nullptr)
        strategy_->sync(parser);
    }
    void reportMatch(antlr4::Parser *parser) {
      if (strategy_ != nullptr)
        strategy_->reportMatch(parser);
    }
    void reportError(antlr4::Parser *parser, const antlr4::RecognitionException &error) {
      if (strategy_ != nullptr)
        strategy_->reportError(parser, error);
    }
    void recover(antlr4::Parser *parser, const std::exception_ptr &error) {
      orGiveUp().recover(parser, error);
    }
    antlr4::Token *recoverInline(antlr4::Parser *parser) {
      return orGiveUp().recoverInline(parser);
    }

  private:
    [[nodiscard]] antlr4::ANTLRErrorStrategy &orGiveUp() const {
      if (strategy_ == nullptr)
        throw antlr4::ParseCancellationException();
      return *strategy_;
    }

    antlr4::ANTLRErrorStrategy *strategy_ = nullptr;
  };

  template <class Action> class AtEnd {
  public:
    explicit AtEnd(Action action) : action_(std::move(action)) {}
    AtEnd(const AtEnd &) = delete;
    AtEnd &operator=(const AtEnd &) = delete;
    ~AtEnd() { action_(); }

  private:
    Action action_;
  };
  template <class Action> static AtEnd<Action> finally(Action action) {
    return AtEnd<Action>(std::move(action));
  }

  ContextBase *_ctx = nullptr;
  UnitStream *_input;
  Errors _errHandler;
  UnitMemory _tracker;

private:
  size_t state_ = 0;
  uint16_t expected_ = 0;
};

// NOLINTEND(readability-identifier-naming)

} // namespace grammar

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_PARSER_BASE_HPP
