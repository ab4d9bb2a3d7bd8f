// SPDX-License-Identifier: BSD-3-Clause
// Arrays that effects are given, of structs that grow: a host that knows a longer struct lays its elements farther apart.
#pragma once
#include <cstddef>

#include <brume/brume_plugin.h>

namespace brume {

template <class T> class Strided {
public:
    class Iterator {
    public:
        explicit Iterator(const unsigned char *at, size_t stride) : at_(at), stride_(stride) {}
        const T &operator*() const { return *reinterpret_cast<const T *>(at_); }
        Iterator &operator++()
        {
            at_ += stride_;
            return *this;
        }
        bool operator!=(const Iterator &other) const { return at_ != other.at_; }

    private:
        const unsigned char *at_;
        size_t stride_;
    };

    // Empty where `first` is NULL.
    Strided(const T *first, size_t size, size_t stride)
        : first_(reinterpret_cast<const unsigned char *>(first)), size_(first ? size : 0), stride_(stride)
    {
    }
    size_t size() const { return size_; }
    const T &operator[](size_t i) const { return *reinterpret_cast<const T *>(first_ + i * stride_); }
    Iterator begin() const { return Iterator(first_, stride_); }
    Iterator end() const { return Iterator(first_ + size_ * stride_, stride_); }

private:
    const unsigned char *first_;
    size_t size_, stride_;
};

inline Strided<brume_plugin_light> lights_in(const brume_plugin_scene &scene)
{
    return {scene.lights, scene.light_count, scene.light_size};
}

// Empty also where planning does not know them yet.
inline Strided<brume_plugin_gaussian> gaussians_in(const brume_plugin_scene &scene)
{
    return {scene.gaussians, scene.gaussian_count, scene.gaussian_size};
}

inline Strided<brume_plugin_product> products_in(const brume_plugin_frame &frame)
{
    return {frame.products, frame.product_count, frame.product_count > 0 ? frame.products->struct_size : 0};
}

}  // namespace brume
