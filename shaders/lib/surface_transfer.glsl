// Diffuse light that the medium brings to surfaces of which frames say what their surroundings let through and send on: precomputed
// radiance transfer (Zhou et al. 2007 par. 4.3). Needs surface_lamp.glsl.
//
// A point's transfer P_lm is the radiance that it sends out, for albedo 1, under a sky of radiance y_lm (environment.glsl says in which
// order and with which signs): with nothing around it, of a lamp's direction d degrees l of the cosine over pi. Degrees that frames do
// not give are the cosine's, times how open the point is by P_00.

const int transfer_degrees = 5;  // of which frames give up to four; a cosine has none of degrees 3 and 5

struct Transfer {
    vec3 of[6];  // coefficient l^2 + l + m of all three layers after one another
};

// Of three coefficients each, for so many degrees.
PURE int layers_of_transfer(int order)
{
    return (order * order + 2) / 3;
}

// What of light from one direction a point sends out, for irradiance 1 across it and albedo 1, degree by degree.
struct Sent {
    float of[5];
};

PURE Sent sent_by_cosine(float cosine)
{
    float square = cosine * cosine;
    Sent sent;
    sent.of[0] = R(0.0795774715459);
    sent.of[1] = R(0.159154943092) * cosine;
    sent.of[2] = R(0.0497359197162) * (R(3.0) * square - R(1.0));
    sent.of[3] = R(0.0);
    sent.of[4] = R(-0.00373019397871) * ((R(35.0) * square - R(30.0)) * square + R(3.0));
    return sent;
}

// d: unit, in the transfer's axes; cosine: between it and the normal.
PURE Sent sent_toward(IN(Transfer) transfer, int order, vec3 d, float cosine)
{
    Sent sent = sent_by_cosine(cosine);
    float open = transfer.of[0].x / R(0.282094791774);
    for (int l = 0; l < transfer_degrees; ++l)
        sent.of[l] *= open;
    if (order > 1)
        sent.of[1] = R(0.488602511903) * (d.y * transfer.of[0].y + d.z * transfer.of[0].z + d.x * transfer.of[1].x);
    float zz = d.z * d.z;
    float across = d.x * d.x - d.y * d.y;
    if (order > 2)
        sent.of[2] = R(1.09254843059) * (d.x * d.y * transfer.of[1].y + d.y * d.z * transfer.of[1].z + d.x * d.z * transfer.of[2].y) +
                     R(0.315391565253) * (R(3.0) * zz - R(1.0)) * transfer.of[2].x + R(0.546274215296) * across * transfer.of[2].z;
    if (order > 3) {
        float five = R(5.0) * zz - R(1.0);
        sent.of[3] = R(0.590043589927) * (d.y * (R(3.0) * d.x * d.x - d.y * d.y) * transfer.of[3].x +
                                          d.x * (d.x * d.x - R(3.0) * d.y * d.y) * transfer.of[5].x) +
                     R(2.89061144264) * d.x * d.y * d.z * transfer.of[3].y + R(1.44530572132) * d.z * across * transfer.of[4].z +
                     R(0.457045799464) * five * (d.y * transfer.of[3].z + d.x * transfer.of[4].y) +
                     R(0.373176332590) * d.z * (five - R(2.0)) * transfer.of[4].x;
    }
    return sent;
}

PURE vec3 in_transfer_axes(IN(Camera) camera, IN(SurfaceSettings) settings, vec3 d)
{
    return settings.world_transfer != 0 ? in_world(camera, d) : d;
}

// A lamp's light that has been scattered any number of times comes as broadly as this at least: the model's light from aside is what
// arrives beside the lamp's way, and of narrow light four degrees can be negative where a point is not lit.
const float narrowest_aside = R(0.5);

// Of a lamp's light from aside by method calibrated (surface_lamp.glsl), the share that a point's surroundings leave: degrees of light
// of this mean cosine around the lamp's way.
PURE float aside_left(float mean_cosine, IN(Sent) sent, float cosine)
{
    Sent clear = sent_by_cosine(cosine);
    float moment = R(1.0);
    float got = R(0.0);
    float most = R(0.0);
    for (int l = 0; l < 4; ++l) {
        got += moment * sent.of[l];
        most += moment * clear.of[l];
        moment *= min(mean_cosine, narrowest_aside);
    }
    return max(got, R(0.0)) / most;
}

// Radiance for albedo 1 and irradiance 1 across a lamp's way in clear air.
PURE float sent_of_lamp(IN(LampMedium) colour, float g, float p, IN(Sent) sent, float cosine)
{
    float x = min(colour.reduced * p, orders_depth_limit);
    float mean_cosine = rescattered_in(colour, x, min(colour.extinction * colour.reduced * p, orders_depth_limit)).cosine;
    float aside = fallen_off(mean_cosine, cosine) * received_in(colour, g, x, cosine).aside;
    return aside / pi * aside_left(mean_cosine, sent, cosine);
}

// Of what arrives at a point of this light in clear air, across its way.
PURE vec3 sent_of_irradiance(IN(Surface) surface, IN(Light) light, vec3 share)
{
    vec3 clear = min(strength_across(surface, light) * light.intensity, vec3(radiance_limit));
    return min(clear * within_spot(surface, light), vec3(radiance_limit)) * share;
}

// Radiance for albedo 1 of what the medium brings of a lamp by method calibrated.
PURE vec3 sent_of_one_lamp(IN(Medium) medium, IN(LampColours) colours, IN(Camera) camera, IN(SurfaceSettings) settings,
                           IN(Surface) surface, IN(Light) light, IN(Transfer) transfer, float p)
{
    float cosine = cosine_to(surface, light);
    Sent sent = sent_toward(transfer, settings.transfer, in_transfer_axes(camera, settings, way_to(surface, light)), cosine);
    vec3 all = vec3(sent_of_lamp(colours.red, colours.asymmetry, p, sent, cosine));
    if (!green_as_red(medium)) {
        all.y = sent_of_lamp(colours.green, colours.asymmetry, p, sent, cosine);
        all.z = all.y;
    }
    if (!blue_as_green(medium))
        all.z = sent_of_lamp(colours.blue, colours.asymmetry, p, sent, cosine);
    return sent_of_irradiance(surface, light, all);
}
