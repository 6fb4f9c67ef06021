// Independent values of the covariance under white noise, slip level 1 and S0 = 1: values.json white.*, where each has
// its method.
#pragma once

#include <limits>

namespace reference {

/// By DOP853, to the relative `error`; gamma = 1 / reach. gaussian_a22: a21 = 0; gaussian: a21 kept.
struct WhiteCovariance {
  const char* id;
  const char* force;
  double gamma, time;
  bool from_rest;  ///< else from (3.38) to (3.40)
  double q11, q12, q22, error;
};
inline constexpr double no_reach = std::numeric_limits<double>::infinity();
inline constexpr WhiteCovariance white_covariances[] = {
    {"white.cov.gamma0.0.ic_thesis.t0.1", "thesis", 0.0, 0.1, false, 0.011840703158494052, 0.027003093065890268,
     0.5481875719492643, 1.1e-11},
    {"white.cov.gamma0.0.ic_thesis.t1", "thesis", 0.0, 1, false, 1.3760847627827533, 1.893568419033666,
     4.021615788104928, 1e-11},
    {"white.cov.gamma0.0.ic_thesis.t1000", "thesis", 0.0, 1000, false, 151531.16748358123, 76.50492119632239,
     15.50313834014999, 1.7e-11},
    {"white.cov.gamma0.0.ic_zero.t1", "thesis", 0.0, 1, true, 1.3660768531975778, 1.8935616263903023, 4.021609405361599,
     2e-11},
    {"white.cov.gamma0.0.ic_zero.t5", "thesis", 0.0, 5, true, 93.01696564510173, 22.426853155369884, 11.040117087821388,
     1.2e-11},
    {"white.cov.gamma0.0.ic_zero.t100", "thesis", 0.0, 100, true, 13822.299041866845, 76.5049184218357,
     15.503138322098913, 1e-11},
    {"white.cov.gamma0.001.ic_thesis.t1", "thesis", 0.001, 1, false, 1.3760848086373034, 1.8935685544595247,
     4.021616130499795, 1e-11},
    {"white.cov.gamma0.001.ic_thesis.t5", "thesis", 0.001, 5, false, 93.027852786679, 22.427333520085607,
     11.040367504650362, 1e-11},
    {"white.cov.gamma0.001.ic_thesis.t10", "thesis", 0.001, 10, false, 447.23606173953965, 46.93297782184971,
     13.96446456130526, 1e-11},
    {"white.cov.gamma0.001.ic_thesis.t100", "thesis", 0.001, 100, false, 14121.610616164724, 80.24997450399061,
     15.896107801020648, 1e-11},
    {"white.cov.gamma0.001.ic_thesis.t1000", "thesis", 0.001, 1000, false, 204823.00110893638, 136.64809058416503,
     20.75005287187786, 1e-11},
    {"white.cov.gamma0.001.ic_zero.t0.1", "thesis", 0.001, 0.1, true, 0.001840581924376499, 0.02700197454507702,
     0.5481770100479659, 1e-11},
    {"white.cov.gamma0.001.ic_zero.t1", "thesis", 0.001, 1, true, 1.3660768928294102, 1.8935617514366534,
     4.021609728982069, 2e-11},
    {"white.cov.gamma0.001.ic_zero.t5", "thesis", 0.001, 5, true, 93.01775863955254, 22.427321472379617,
     11.040365350666393, 1.2e-11},
    {"white.cov.gamma0.001.ic_zero.t10", "thesis", 0.001, 10, true, 447.22585910988823, 46.93296856062834,
     13.964463680365691, 1.1e-11},
    {"white.cov.gamma0.01.ic_thesis.t1", "thesis", 0.01, 1, false, 1.3760893480132912, 1.8935819606200706,
     4.021650024659145, 1e-11},
    {"white.cov.gamma0.01.ic_thesis.t5", "thesis", 0.01, 5, false, 93.106073982284, 22.473391640667977,
     11.064750789927972, 1e-11},
    {"white.cov.gamma0.01.ic_thesis.t100", "thesis", 0.01, 100, false, 60378.79671732601, 934.7001418833728,
     64.07448568603266, 3.6e-11},
    {"white.cov.gamma0.01.ic_zero.t0.1", "thesis", 0.01, 0.1, true, 0.001840581925949452, 0.027001974595803467,
     0.5481770113594947, 1e-11},
    {"white.cov.gamma0.01.ic_zero.t100", "thesis", 0.01, 100, true, 60378.636542067616, 934.6979669585087,
     64.07440183689505, 1.2e-11},
    {"white.cov.gamma0.1.ic_thesis.t0.1", "thesis", 0.1, 0.1, false, 0.011840727582173598, 0.02700351731175683,
     0.5481953038690365, 1.1e-11},
    {"white.cov.gamma0.1.ic_thesis.t5", "thesis", 0.1, 5, false, 98.86502452739143, 25.537643402913936,
     12.60673481084311, 1e-11},
    {"white.cov.gamma0.1.ic_thesis.t10", "thesis", 0.1, 10, false, 623.4984633619168, 86.75235613748157,
     23.806416737926202, 1e-11},
    {"white.cov.gamma0.1.ic_thesis.t100", "thesis", 0.1, 100, false, 1103020.4082706464, 18628.242478050324,
     450.8150716402549, 1.5e-10},
    {"white.cov.gamma0.1.ic_thesis.t1000", "thesis", 0.1, 1000, false, 1840857866.6915348, 2852388.740044493,
     5939.364054940211, 1e-11},
    {"white.cov.gamma0.1.ic_zero.t0.1", "thesis", 0.1, 0.1, true, 0.0018405820832435055, 0.02700197966840549,
     0.54817714251117, 1e-11},
    {"white.cov.gamma0.1.ic_zero.t5", "thesis", 0.1, 5, true, 98.84587343009778, 25.535176323209406, 12.605924142755557,
     1e-11},
    {"white.cov.gamma0.1.ic_zero.t10", "thesis", 0.1, 10, true, 623.43546272347, 86.74593563425496, 23.805398634599314,
     1.3e-11},
    {"white.cov.gamma0.1.ic_zero.t100", "thesis", 0.1, 100, true, 1103006.3293081196, 18628.07782923648,
     450.8129726002897, 1.2e-10},
    {"white.cov.gamma0.1.ic_zero.t1000", "thesis", 0.1, 1000, true, 1840855711.851797, 2852386.503062484,
     5939.361708490484, 1e-11},
    {"white.cov.gamma1.0.ic_thesis.t0.1", "thesis", 1.0, 0.1, false, 0.011843077000925045, 0.02704432362132018,
     0.5489389034803569, 1e-11},
    {"white.cov.gamma1.0.ic_thesis.t1", "thesis", 1.0, 1, false, 1.4100116808138448, 1.9830125241602876,
     4.235566477234638, 1e-11},
    {"white.cov.gamma1.0.ic_thesis.t5", "thesis", 1.0, 5, false, 158.73376560204565, 49.066529650967645,
     22.353557187418534, 1e-11},
    {"white.cov.gamma1.0.ic_thesis.t1000", "thesis", 1.0, 1000, false, 2057494638.3145337, 3101199.488321925,
     6237.54115863985, 1e-11},
    {"white.cov.gamma1.0.ic_zero.t0.1", "thesis", 1.0, 0.1, true, 0.0018405978040031317, 0.027002486520863282,
     0.5481902456313308, 1e-11},
    {"white.cov.gamma1.0.ic_zero.t100", "thesis", 1.0, 100, true, 1885068.68127096, 28982.98469240769,
     598.7539944521826, 3.4e-11},
    {"white.cov.gamma10.0.ic_thesis.t1", "thesis", 10.0, 1, false, 1.7528235288195229, 2.6189751561372185,
     5.461274605144782, 1e-11},
    {"white.cov.gamma10.0.ic_zero.t10", "thesis", 10.0, 10, true, 1929.1022359697154, 294.41185973165864,
     60.35727033718936, 1e-11},
    {"white.cov.gammainf.ic_thesis.t0.1", "thesis", no_reach, 0.1, false, 0.0120945359023932, 0.03141728053589797,
     0.6283315307179584, 1e-11},
    {"white.cov.gammainf.ic_thesis.t10", "thesis", no_reach, 10, false, 2094.4064034732028, 314.1593954129793,
     62.83186607179583, 1e-11},
    {"white.cov.gammainf.ic_thesis.t1000", "thesis", no_reach, 1000, false, 2094395115.403307, 3141592.6665898506,
     6283.185320179584, 1e-11},
    {"white.cov.gammainf.ic_zero.t0.1", "thesis", no_reach, 0.1, true, 0.0020943951023931883, 0.03141592653589794,
     0.6283185307179583, 1e-11},
    {"white.cov.gammainf.ic_zero.t1", "thesis", no_reach, 1, true, 2.094395102393202, 3.1415926535897905,
     6.283185307179584, 1e-11},
    {"white.cov.gammainf.ic_zero.t5", "thesis", no_reach, 5, true, 261.79938779914966, 78.5398163397449,
     31.415926535897917, 1e-11},
    {"white.cov.gammainf.ic_zero.t10", "thesis", no_reach, 10, true, 2094.3951023931995, 314.1592653589798,
     62.831853071795834, 1e-11},
    {"white.cov_gauss_a22.gamma0.01.t0.1", "gaussian_a22", 0.01, 0.1, true, 0.0018405819248900543, 0.02700197457391311,
     0.5481770107189632, 4.1e-10},
    {"white.cov_gauss_a22.gamma0.01.t1", "gaussian_a22", 0.01, 1, true, 1.3660788336972707, 1.893567879440075,
     4.021625586007955, 9.3e-10},
    {"white.cov_gauss_a22.gamma0.01.t10", "gaussian_a22", 0.01, 10, true, 449.2159912412707, 47.47089135393867,
     14.114448679770684, 4.5e-10},
    {"white.cov_gauss_full.gamma0.01.t0.1", "gaussian", 0.01, 0.1, true, 0.0018405819299749239, 0.02700197473663919,
     0.5481770142200966, 4.1e-10},
    {"white.cov_gauss_full.gamma0.01.t5", "gaussian", 0.01, 5, true, 93.19071334407863, 22.52415675376518,
     11.079203081563705, 1.1e-08},
    {"white.cov_gauss_full.gamma0.01.t100", "gaussian", 0.01, 100, true, 99192.3861922588, 1997.5354358991503,
     87.29749253972801, 5.2e-10},
    {"white.cov_gauss_a22.gamma0.1.t1", "gaussian_a22", 0.1, 1, true, 1.3662745921845407, 1.8941849249513845,
     4.02322178672731, 9.5e-10},
    {"white.cov_gauss_a22.gamma0.1.t5", "gaussian_a22", 0.1, 5, true, 96.39754380914424, 24.307415711540074,
     12.008312663545864, 2e-09},
    {"white.cov_gauss_a22.gamma0.1.t10", "gaussian_a22", 0.1, 10, true, 568.4443101200151, 75.73183124642672,
     21.337375190486814, 3.5e-09},
    {"white.cov_gauss_full.gamma0.1.t1", "gaussian", 0.1, 1, true, 1.3672846153585252, 1.8972765519959764,
     4.029514562706864, 8.7e-10},
    {"white.cov_gauss_full.gamma0.1.t5", "gaussian", 0.1, 5, true, 105.65297427224881, 28.874791918601936,
     13.68543673121516, 9.1e-10},
    {"white.cov_gauss_a22.gamma1.0.t0.1", "gaussian_a22", 1.0, 0.1, true, 0.001840589866463356, 0.027002230656537844,
     0.5481836314042038, 4.1e-10},
    {"white.cov_gauss_a22.gamma1.0.t10", "gaussian_a22", 1.0, 10, true, 1331.0800911331849, 212.09848727807343,
     48.23112264680089, 1.4e-07},
    {"white.cov_gauss_a22.gamma1.0.t100", "gaussian_a22", 1.0, 100, true, 1873032.7004508711, 28856.199432147638,
     597.4033278438324, 8e-10},
    {"white.cov_gauss_full.gamma1.0.t0.1", "gaussian", 1.0, 0.1, true, 0.001840640649856936, 0.027003854872514596,
     0.5482185710725888, 4.2e-10},
};

/// Quadrature in 30 digits; slip level 1.
struct WhiteCoefficients {
  const char* id;
  double q11, q12, q22, reach;
  double a22_thesis, a22, a21;
};
inline constexpr WhiteCoefficients white_coefficients[] = {
    {"white.a22.q10_3_4.L1", 10.0, 3.0, 4.0, 1.0, -0.13782603103637991, -0.15829387481924045, 0.039332473544315114},
    {"white.a22.q400_60_15.L10", 400.0, 60.0, 15.0, 10.0, -0.11974747445743512, -0.13719998857850926,
     0.014316482518203052},
    {"white.a22.q400_60_15.L1000", 400.0, 60.0, 15.0, 1000.0, -0.20597996148960984, -0.2059964300082161,
     1.2350895965692734e-05},
};

/// Thesis (3.51) in closed form.
struct Transition {
  double gamma, time;
};
inline constexpr Transition transitions[] = {
    {0.0359, 5.002890150678052},
    {0.05, 3.7745065574936936},
};

}  // namespace reference
