/* SPDX-License-Identifier: BSD-3-Clause
 * The camera: an orbit round a target, perspective or orthographic. */
#ifndef METAMER_CAMERA_H
#define METAMER_CAMERA_H

#include "metamer/volume.h"

#ifdef __cplusplus
extern "C" {
#endif

/* eye = target + distance · (cos el · sin az, sin el, cos el · cos az) in the frame whose second axis is `up`: the
 * world's axes turned the shortest way that takes y to `up` (up = z looks at a patient from the front). */
typedef struct mtm_camera {
    double azimuth, elevation; /* degrees; defaults 30, 20 */
    double distance;           /* world units; 0: 1.75 × the longest edge of the volume's box */
    bool has_target;           /* false: the box's center */
    double target[3];          /* world */
    double up[3];              /* not zero; default (0, 1, 0) */
    double fov;                /* vertical, degrees, 0 … 175; 0 is orthographic; default 30 */
    double height;             /* of an orthographic view, world units; 0: 2 · distance · tan 15° */
} mtm_camera;

MTM_API mtm_camera mtm_camera_defaults(void);

/* A camera ready for rays. Directions have unit length. */
typedef struct mtm_view {
    double eye[3];
    double right[3], up[3], forward[3];
    double half_height; /* of the picture: at distance 1 (perspective) or in world units (orthographic) */
    bool is_orthographic;
} mtm_view;

/* The view of a grid: fills in what the camera leaves to the volume. */
MTM_API mtm_view mtm_camera_view(const mtm_camera *camera, const mtm_grid *grid);

/* The ray through a point of a width × height picture, in pixels from its top left corner; the center of the first
 * pixel is (0.5, 0.5). `direction` has unit length; perspective rays begin in the eye. */
MTM_API void mtm_view_ray(const mtm_view *view, int width, int height, double x, double y, double origin[3],
                          double direction[3]);

#ifdef __cplusplus
}
#endif
#endif
