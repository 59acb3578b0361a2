#pragma once
/// An array of a mesh: as a vector, or in a file that is mapped. Reading is the same for both; whoever
/// changes one that is mapped gets a copy of its own first.

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace acentric {

template <class T>
class MeshArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using value_type = T;
  using size_type = std::size_t;
  using difference_type = std::ptrdiff_t;
  using reference = T&;
  using const_reference = const T&;
  using iterator = T*;
  using const_iterator = const T*;

  MeshArray() = default;
  MeshArray(std::vector<T> values) : own_(std::move(values)) { look(); }
  MeshArray(std::initializer_list<T> values) : own_(values) { look(); }
  explicit MeshArray(std::size_t size, const T& value = T{}) : own_(size, value) { look(); }
  /// `values` stay as long as `owner`; copies share them. kPadding bytes behind them can be read.
  static MeshArray mapped(std::span<const T> values, std::shared_ptr<const void> owner) {
    MeshArray out;
    out.owner_ = std::move(owner);
    out.data_ = values.data();
    out.size_ = values.size();
    return out;
  }
  MeshArray(const MeshArray& other) : own_(other.own_), owner_(other.owner_) { look(other); }
  MeshArray(MeshArray&& other) noexcept : own_(std::move(other.own_)), owner_(std::move(other.owner_)) {
    look(other);
    other.clear();
  }
  MeshArray& operator=(MeshArray other) noexcept {
    own_ = std::move(other.own_);
    owner_ = std::move(other.owner_);
    look(other);
    return *this;
  }
  ~MeshArray() = default;

  /// Ray tracers read 16 bytes at a time.
  static constexpr std::size_t kPadding = 16;
  bool isMapped() const { return owner_ != nullptr; }

  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  const T& front() const { return data_[0]; }
  const T& back() const { return data_[size_ - 1]; }
  bool operator==(const MeshArray& other) const { return std::ranges::equal(*this, other); }

  T* data() { return own().data(); }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  T& operator[](std::size_t i) { return own()[i]; }
  T& front() { return own().front(); }
  T& back() { return own().back(); }
  void reserve(std::size_t size) { own().reserve(size), look(); }
  void resize(std::size_t size) { own().resize(size), look(); }
  void push_back(T value) { own().push_back(value), look(); }
  void pop_back() { own().pop_back(), look(); }
  template <class... Arguments>
  T& emplace_back(Arguments&&... arguments) {
    T& made = own().emplace_back(std::forward<Arguments>(arguments)...);
    look();
    return made;
  }
  void assign(std::size_t size, T value) { own().assign(size, value), look(); }
  template <std::input_iterator I>
  void assign(I first, I last) {
    own().assign(first, last), look();
  }
  template <std::input_iterator I>
  void insert(const T* before, I first, I last) {
    const std::ptrdiff_t at = before - data_;
    std::vector<T>& all = own();
    all.insert(all.begin() + at, first, last);
    look();
  }
  void clear() {
    owner_ = nullptr;
    own_.clear();
    look();
  }

 private:
  std::vector<T>& own() {
    if (owner_) {
      own_.assign(data_, data_ + size_);
      owner_ = nullptr;
      look();
    }
    return own_;
  }
  void look() { data_ = own_.data(), size_ = own_.size(); }
  /// After its contents were taken from `other`.
  void look(const MeshArray& other) {
    if (!owner_) return look();
    data_ = other.data_, size_ = other.size_;
  }

  std::vector<T> own_;                 ///< empty where mapped
  std::shared_ptr<const void> owner_;  ///< null where not
  const T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace acentric
