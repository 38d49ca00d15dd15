/* SPDX-License-Identifier: BSD-3-Clause
 * SplitMix64: G. L. Steele, D. Lea, C. H. Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014;
 * constants of S. Vigna's version of it, which is in the public domain. */
#include "random.h"

#include <assert.h>

uint64_t random_bits(random_state *state) {
    *state += UINT64_C(0x9e3779b97f4a7c15);
    uint64_t bits = *state;
    bits = (bits ^ (bits >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    bits = (bits ^ (bits >> 27)) * UINT64_C(0x94d049bb133111eb);
    return bits ^ (bits >> 31);
}

/* The upper half of 32 bits times the count: some numbers are likelier by at most count / 2³². */
int random_below(random_state *state, int count) {
    assert(count >= 1);
    return (int)(((random_bits(state) >> 32) * (uint64_t)count) >> 32);
}

double random_between(random_state *state, double low, double high) {
    const double unit = (double)(random_bits(state) >> 11) * 0x1p-53;
    return low + unit * (high - low);
}

static int draw_from(int pool_count, const index_pool *pools, random_state *state) {
    const index_pool pool = pools[random_below(state, pool_count)];
    return pool.first + random_below(state, pool.count);
}

void draw_products(const draw_pools *pools, random_state seed, int count, product_draw *draws) {
    random_state state = seed;
    for (int n = 0; n < count; n++) {
        draws[n].light = draw_from(pools->light_pool_count, pools->light_pools, &state);
        for (int i = 0; i < DRAW_REFLECTANCES; i++)
            draws[n].reflectance[i] =
                draw_from(pools->reflectance_pool_count, pools->reflectance_pools, &state);
    }
}
