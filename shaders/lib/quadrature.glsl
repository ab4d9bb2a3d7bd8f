// Gauss-Legendre nodes and weights on [0, 1].

const int max_quadrature_nodes = 16;

// Of 1, 2, 3, 4, 6, 8, 12 and 16 nodes, those in the upper half of [-1, 1]; their weights add up to 1.
const int quadrature_count = 27;
const float quadrature_node[quadrature_count] = {
    R(0.0),
    R(0.577350269189626),
    R(0.0), R(0.774596669241483),
    R(0.339981043584856), R(0.861136311594053),
    R(0.238619186083197), R(0.661209386466265), R(0.932469514203152),
    R(0.18343464249565), R(0.525532409916329), R(0.796666477413627), R(0.960289856497536),
    R(0.125233408511469), R(0.36783149899818), R(0.587317954286617), R(0.769902674194305), R(0.904117256370475),
    R(0.981560634246719),
    R(0.0950125098376374), R(0.281603550779259), R(0.458016777657227), R(0.617876244402644), R(0.755404408355003),
    R(0.865631202387832), R(0.944575023073233), R(0.98940093499165)};
const float quadrature_weight[quadrature_count] = {
    R(1.0),
    R(0.5),
    R(0.444444444444444), R(0.277777777777778),
    R(0.326072577431273), R(0.173927422568727),
    R(0.233956967286346), R(0.180380786524069), R(0.0856622461895852),
    R(0.181341891689181), R(0.156853322938944), R(0.111190517226687), R(0.0506142681451881),
    R(0.124573522906701), R(0.116746268269177), R(0.101583713361533), R(0.0800391642716731), R(0.0534696629976592),
    R(0.0235876681932559),
    R(0.0947253052275342), R(0.0913017075224618), R(0.0845782596975013), R(0.0747979944082884), R(0.0623144856277669),
    R(0.0475792558412464), R(0.0311267619693239), R(0.013576229705877)};

// The largest count of nodes there is that is at most n, n >= 1.
PURE int quadrature_nodes(int n)
{
    return n >= 16 ? 16 : n >= 12 ? 12 : n >= 8 ? 8 : n >= 6 ? 6 : clamp(n, 1, 4);
}

// Node k of n and its weight; n as quadrature_nodes gives it.
PURE vec2 gauss_legendre(int n, int k)
{
    int first = n <= 2 ? n - 1 : n == 3 ? 2 : n == 4 ? 4 : n == 6 ? 6 : n == 8 ? 9 : n == 12 ? 13 : 19;
    int half_count = n / 2;
    bool upper = k >= half_count;
    int i = upper ? k - half_count : n - 1 - k - half_count;
    float x = R(0.5) * quadrature_node[first + i];
    return vec2(upper ? R(0.5) + x : R(0.5) - x, quadrature_weight[first + i]);
}
