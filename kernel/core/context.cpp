#include "kernel/core/context.h"

#include <algorithm>
#include <utility>

#include "kernel/core/context_state.h"
#include "kernel/core/error.h"

namespace lissom {

void MemoryAccount::require_room(std::size_t used, std::size_t bytes,
                                 std::string_view purpose) const {
    if (limit_ == 0 || overdrafts_.load(std::memory_order_relaxed) > 0) return;
    if (bytes <= limit_ - std::min(limit_, used)) return;
    throw Error(ErrorCode::memory_limit,
                std::string(purpose) + " needs " + std::to_string(bytes) + " bytes, but " +
                    std::to_string(used) + " of the limit of " + std::to_string(limit_) +
                    " are in use; raise the limit or use a smaller region or mesh");
}

void MemoryAccount::charge(std::size_t bytes, std::string_view purpose) {
    std::size_t before = used_.load();
    do {
        require_room(before, bytes, purpose);
    } while (!used_.compare_exchange_weak(before, before + bytes));
    try {
        if (within_) within_->charge(bytes, purpose);
    } catch (...) {
        used_.fetch_sub(bytes);
        throw;
    }
    const std::size_t now = before + bytes;
    std::size_t peak = peak_.load();
    while (peak < now && !peak_.compare_exchange_weak(peak, now)) {
    }
}

void MemoryAccount::release(std::size_t bytes) {
    used_.fetch_sub(bytes);
    if (within_) within_->release(bytes);
}

MemoryOverdraft::MemoryOverdraft(std::shared_ptr<MemoryAccount> account)
    : account_(std::move(account)) {
    for (MemoryAccount* at = account_.get(); at; at = at->within_.get()) ++at->overdrafts_;
}

MemoryOverdraft::~MemoryOverdraft() {
    for (MemoryAccount* at = account_.get(); at; at = at->within_.get()) --at->overdrafts_;
}

MemoryCharge::MemoryCharge(std::shared_ptr<MemoryAccount> account, std::size_t bytes,
                           std::string_view purpose) {
    account->charge(bytes, purpose);
    account_ = std::move(account);
    bytes_ = bytes;
}

MemoryCharge::MemoryCharge(MemoryCharge&& other) noexcept
    : account_(std::move(other.account_)), bytes_(std::exchange(other.bytes_, 0)) {}

MemoryCharge& MemoryCharge::operator=(MemoryCharge&& other) noexcept {
    if (this == &other) return *this;
    if (account_) account_->release(bytes_);
    account_ = std::move(other.account_);
    bytes_ = std::exchange(other.bytes_, 0);
    return *this;
}

MemoryCharge::~MemoryCharge() {
    if (account_) account_->release(bytes_);
}

Context::Context() : Context(ContextOptions{}) {}

Context::Context(ContextOptions options) : state_(std::make_shared<State>(std::move(options))) {}

void Context::cancel() const {
    state_->cancelled.store(true);
}

void Context::clear_cancel() const {
    state_->cancelled.store(false);
}

bool Context::cancelled() const {
    return state_->cancelled.load(std::memory_order_relaxed);
}

void Context::checkpoint() const {
    if (cancelled()) throw Error(ErrorCode::cancelled, "cancelled; nothing was changed");
}

void Context::log(LogLevel level, std::string_view message) const {
    if (state_->options.log) state_->options.log(level, message);
}

int Context::threads() const {
    return state_->options.threads;
}

const FileTable& Context::files() const {
    return files_ ? *files_ : state_->options.files;
}

std::shared_ptr<MemoryAccount> Context::memory() const {
    return account_ ? account_ : state_->memory;
}

Context Context::charging(std::shared_ptr<MemoryAccount> account) const {
    Context other = *this;
    other.account_ = std::move(account);
    return other;
}

Context Context::with_files(FileTable files) const {
    Context other = *this;
    other.files_ = std::make_shared<const FileTable>(std::move(files));
    return other;
}

MemoryCharge Context::charge(std::size_t bytes, std::string_view purpose) const {
    return {memory(), bytes, purpose};
}

Progress::Progress(const Context& context, std::string_view label)
    : state_(context.state_), context_(context), label_(label) {
    context.checkpoint();
    if (state_->progress_depth++ == 0) {
        state_->window_begin = 0.0;
        state_->window_end = 1.0;
        state_->reported = 0.0;
    }
    outer_begin_ = step_begin_ = state_->window_begin;
    outer_end_ = state_->window_end;
    step_end_ = outer_begin_;
    report(outer_begin_);
}

Progress::~Progress() {
    --state_->progress_depth;
    state_->window_begin = outer_begin_;
    state_->window_end = outer_end_;
}

void Progress::step(double fraction) {
    context_.checkpoint();
    step_begin_ = step_end_;
    step_end_ = std::min(outer_end_, step_begin_ + fraction * (outer_end_ - outer_begin_));
    state_->window_begin = step_begin_;
    state_->window_end = step_end_;
    report(step_begin_);
}

void Progress::update(double fraction) {
    context_.checkpoint();
    const bool whole = step_end_ == outer_begin_;
    const double begin = whole ? outer_begin_ : step_begin_;
    const double end = whole ? outer_end_ : step_end_;
    report(begin + std::clamp(fraction, 0.0, 1.0) * (end - begin));
}

void Progress::report(double fraction) {
    state_->reported = std::max(state_->reported, fraction);
    if (state_->options.progress) state_->options.progress(label_, state_->reported);
}

}  // namespace lissom
