#pragma once
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include <brume/brume_plugin.h>

namespace brume {

// What the host and the effects of one plan make for others.
class Products {
public:
    struct Product {
        std::string name;
        std::vector<brume_plugin_image> images;
        uint64_t revision = 0;
        uint32_t count = 0;
    };

    // The product of this name, without images until somebody makes it. Stays where it is.
    Product &of(std::string_view name);

    // A product's images from now on.
    void publish(std::string_view name, const brume_plugin_image *images, uint32_t image_count, uint32_t count,
                 uint64_t revision);

    static brume_plugin_product seen(const Product &product)
    {
        return {sizeof(brume_plugin_product),
                uint32_t(product.images.size()),
                product.images.data(),
                product.revision,
                product.count,
                0};
    }

private:
    std::deque<Product> products_;
};

}  // namespace brume
