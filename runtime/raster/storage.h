// SPDX-License-Identifier: MIT
//
// An array whose elements start undefined and whose memory is kept when it is emptied.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>

namespace kaamos::raster {

template <class T>
class Storage {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  size_t size() const { return size_; }
  size_t bytes() const { return capacity_ * sizeof(T); }
  T& operator[](size_t i) { return data_[i]; }
  const T& operator[](size_t i) const { return data_[i]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }

  void clear() { size_ = 0; }
  void release() {
    data_.reset();
    size_ = capacity_ = 0;
  }
  // New elements are undefined, the others are kept.
  T* resize(size_t size) {
    if (size > capacity_) grow(size);
    size_ = size;
    return data();
  }
  void reserve(size_t size) {
    if (size > capacity_) grow(size);
  }
  void push_back(const T& value) {
    if (size_ == capacity_) grow(size_ + 1);
    data_[size_++] = value;
  }

 private:
  struct Free {
    void operator()(T* memory) const { std::free(memory); }
  };

  void grow(size_t size) {
    size_t capacity = capacity_ + capacity_ / 2;
    if (capacity < size) capacity = size;
    constexpr size_t kAlignment = 64;
    const size_t bytes = (capacity * sizeof(T) + kAlignment - 1) / kAlignment * kAlignment;
    T* memory = static_cast<T*>(std::aligned_alloc(kAlignment, bytes));
    if (memory == nullptr) throw std::bad_alloc();
    if (size_ != 0) std::memcpy(static_cast<void*>(memory), data_.get(), size_ * sizeof(T));
    data_.reset(memory);
    capacity_ = capacity;
  }

  std::unique_ptr<T[], Free> data_;
  size_t size_ = 0;
  size_t capacity_ = 0;
};

}  // namespace kaamos::raster
