/* SPDX-License-Identifier: BSD-3-Clause
 * Random numbers that are the same on every machine, and random products of a light and reflectances. */
#ifndef METAMER_ACCURACY_RANDOM_H
#define METAMER_ACCURACY_RANDOM_H

#include <stdint.h>

/* The state of the generator; any value is a good seed. */
typedef uint64_t random_state;

/* 64 random bits. */
uint64_t random_bits(random_state *state);

/* An integer of 0 … count-1, 1 ≤ count < 2³². */
int random_below(random_state *state, int count);

/* A number of [low, high). */
double random_between(random_state *state, double low, double high);

/* Consecutive indices from which one is drawn, each as likely as the others; count ≥ 1. */
typedef struct index_pool {
    int first, count;
} index_pool;

/* A light and the reflectances that it meets one after the other. */
enum { DRAW_REFLECTANCES = 3 };
typedef struct product_draw {
    int light;
    int reflectance[DRAW_REFLECTANCES];
} product_draw;

/* Where draws come from: a pool, each as likely as the others (a pool named twice is twice as likely), then one of its
 * indices. */
typedef struct draw_pools {
    int light_pool_count, reflectance_pool_count;
    const index_pool *light_pools, *reflectance_pools;
} draw_pools;

void draw_products(const draw_pools *pools, random_state seed, int count, product_draw *draws);

#endif
