// Made-up record files as agencies lay them out, field by field, for the tests and the fuzz target of the readers.
#pragma once

#include <string>

#include "ground/record_files.hpp"

namespace record_files {

/// As AFAD wrote it until about 2018: three columns.
inline std::string afad(const std::string& columns = "       N-S          E-W          U-D", int count = 5) {
  return "STRONG GROUND MOTION RECORDS OF TURKIYE\nPLACE                   : MADE-UP DEVLET HASTANESI\n"
         "EARTHQUAKE DATE         : 2001/02/03 04:05:06 (GMT)\nEPICENTER COORDINATES   : 36.91980N-27.44350E\n"
         "EARTHQUAKE DEPTH (km)   : 19.44\nEARTHQUAKE MAGNITUDE    : 6.5 Mw\nSTATION ID              : 9999\n"
         "STATION COORDINATES     : 37.87470N-27.59223E\nSTATION ALTITUDE (m)    : 66\n"
         "RECORDER TYPE           : Made-up recorder\nRECORDER SERIAL NO      : 1\n"
         "RECORD TIME             : 03/02/2001 04:05:01.000000 (GMT)\nNUMBER OF DATA          : " +
         std::to_string(count) +
         "\nSAMPLING INTERVAL (sec) : 0.01\n"
         "RAW PGA VALUES (gal)    : (N-S) 99.000000 (E-W) 98.000000 (U-D) 97.000000\n"
         "Copyright EARTHQUAKE DEPARTMENT\nDISASTER AND EMERGENCY MANAGEMENT PRESIDENCY\n" +
         columns +
         "\n    0.000909     -0.000191    -0.000092\n    1.500000     -0.250000    -0.000083\n"
         "   -9.806650      0.500000    12.345678\n    0.250000     -3.000000     0.000000\n"
         "    0.000001      0.000002    -0.000003\n";
}

/// Taiwan's free format: the third field of the last row fills its columns.
inline std::string cwb(const std::string& order = "Time U(+); N(+); E(+)", const std::string& rate = "50") {
  return "#Earthquake Information\n#Origin Time(GMT+08): 2001/02/03-04:05:06\n#EpicenterLongitude(E): 121.69\n"
         "#EpicenterLatitude(N): 24.14\n#Depth(km): 10.0\n#Magnitude(Ml): 6.0\n\n#Station Information\n"
         "#StationCode: MAD\n#StationName: Made-up\n#StationLongitude(E): 120.857\n#StationLatitude(N): 22.381\n"
         "#InstrumentKind: FBA\n#StartTime(GMT+08): 2001/02/03-04:05:01.000\n#RecordLength(sec): 0.1\n"
         "#SampleRate(Hz): " +
         rate +
         "\n#AmplitudeUnit:  gal. DCoffset(corr)\n#AmplitudeMAX. U:    1.250~   -0.500\n"
         "#AmplitudeMAX. N: 1234.567~  -98.067\n#AmplitudeMAX. E:12345.679~    0.000\n#DataSequence: " +
         order +
         "\n#Data: 4F10.3 \n     0.000     0.000     1.000     0.000\n     0.020     1.250   -98.067     3.000\n"
         "     0.040    -0.500     2.000     4.000\n     0.060     0.000     3.000     5.000\n"
         "     0.080     0.000  1234.56712345.679\n";
}

inline const std::string asa_rule = std::string(80, '=') + "\n",
                         asa_ruler = "---------+---------+---------+---------+\n";

/// The standard file of acceleration of Mexico, version 2.0, with 109 lines of header and the last row once more.
inline std::string asa(int count = 4) {
  const std::string samples = std::to_string(count), c7 = " C7-C12";
  std::string text =
      std::string(86, '*') +
      "\n                       INSTITUTO MADE-UP\n                  Coordinacion\n  Ciudad, Mexico, D.F.\n"
      " Tel.(52-5)000-0000    Fax.(52-5)000-0000\n" +
      std::string(86, '*') +
      "\nARCHIVO ESTANDAR DE ACELERACION:\nVERSION DEL FORMATO                    : 2.0\n"
      "NOMBRE DEL ARCHIVO                     : MADE0102.031\n"
      "FECHA Y HORA DE CREACION               : Mon Mar 23 16:21:00 2001\n"
      "REF. CATALOGO ACELEROGRAMAS, SMIS 1995 : REGISTRO No. 1 /PAG. 1\n\n\n" +
      asa_rule +
      "DATOS DE LA ESTACION:\nNOMBRE DE LA ESTACION                  : ACANTILADO\n"
      "CLAVE DE LA ESTACION                   : MADE\nLOCALIZACION DE LA ESTACION            : CALLE 1\n";
  for (int i = 0; i < 4; ++i) text += "                                       :\n";
  text +=
      "COORDENADAS DE LA ESTACION             : 16.84851 LAT. N\n"
      "                                       : 99.85157 LONG. W\nALTITUD (msnm)                         : 5\n"
      "TIPO DE SUELO                          : ROCA\n                                       :\n"
      "                                       :\nINSTITUCION RESPONSABLE                : INSTITUTO MADE-UP\n"
      "                                       :\n\n" +
      asa_rule +
      "DATOS DEL ACELEROGRAFO: \nMODELO DEL ACELEROGRAFO                : DCA-333\n"
      "NUMERO DE SERIE DEL ACELEROGRAFO       : 123\nNUMERO DE CANALES                      : 3\n"
      "ORIENTACION C1-C6 (rumbo;orientacion)  : /V;+/N90E/N00E\nORIENTACION C7-C12 (rumbo;orientacion) :\n"
      "VEL. DE MUESTREO, C1-C6 (muestras/s)   : /250/250/250\nVEL. DE MUESTREO, C7-C12 (muestras/s)  :\n"
      "ESC. COMPLETA DE SENSORES, C1-C6, (g)  : /2/2/2\nESC. COMPLETA DE SENSORES, C7-C12 (g)  :\n"
      "FREC. NAT. DE SENSORES, C1-C6, (Hz)    : /32.0/31.0/30.0\nFREC. NAT. DE SENSORES, C7-C12 (Hz)    :\n"
      "AMORTIGUAMIENTO DE SENSORES, C1-C6     : /0.66/0.66/0.68\nAMORTIGUAMIENTO DE SENSORES, C7-C12    :\n"
      "INTERVALO DE MUESTREO, C1-C6 (s)       : /0.004/0.004/0.004\nINTERVALO DE MUESTREO, C7-C12 (s)      :\n"
      "UMBRAL DE DISPARO, C1-C6 (Gal)         : /6/6/6\nUMBRAL DE DISPARO, C7-C12 (Gal)        :\n"
      "MEMORIA DE PREEVENTO (s)               : 4\nTIEMPO DE POSEVENTO (s)                : 15\n\n\n" +
      asa_rule +
      "DATOS DEL SISMO:\nFECHA DEL SISMO [GMT]                  : 2001/02/03\n"
      "HORA EPICENTRO (GMT)                   : 04:05:06.0\nMAGNITUD(ES)                           : /Mb=5.30/Ms=4.80\n"
      "COORDENADAS DEL EPICENTRO              : 17.446 LAT. N \n"
      "                                       : 101.089 LONG. W\nPROFUNDIDAD FOCAL (km)                 : 18 \n"
      "FUENTES DE LOS DATOS EPICENTRALES      : INSTITUTO MADE-UP\n                                       : \n\n" +
      asa_rule +
      "DATOS DE ESTE REGISTRO:\nHORA DE LA PRIMERA MUESTRA (GMT)       : 04:05:30.00\n"
      "EXACTITUD DEL TIEMPO (s)               : 1.00\nDURACION DEL REGISTRO (s), C1-C6       : /0.016/0.016/0.016  \n"
      "DURACION DEL REGISTRO (s), C7-C12      : \nNUM. TOTAL DE MUESTRAS, C1-C6          : /" +
      samples + "/" + samples + "/" + samples +
      "   \nNUM. TOTAL DE MUESTRAS, C7-C12         : \nACEL. MAX.(Gal), C1-C6                 : /-1.45/98.07/-0.64 \n"
      "ACEL. MAX., C1-C6, EN LA MUESTRA       : /1/3/0 \nACEL. MAX.(Gal), C7-C12                : \n"
      "ACEL. MAX., C7-C12,EN LA MUESTRA       : \nUNIDADES DE LOS DATOS                  : Gal (cm/s/s)\n"
      "FACTOR DE DECIMACION                   : 1\nFORMATO DATOS (FORTRAN,10 campos/dato) : 3F10.2\n\n\n" +
      asa_rule + "CALIDAD DEL ACELEROGRAMA:\nRegistro completo\n\n\n" + asa_rule + "COMENTARIOS:\n" +
      std::string(14, '\n') + asa_rule + "DATOS DE ACELERACION:\n" + asa_ruler +
      "   CANAL-1   CANAL-2   CANAL-3\n      V;+      N90E      N00E\n" + asa_ruler;
  return text +
         "      0.46      2.33     -0.64\n     -1.45      0.42      0.32\n      0.46      0.42      0.32\n"
         "      0.50    -98.07      0.25\n      0.50    -98.07      0.25\n";
}

/// As the network of China writes it.
inline std::string csmnc(const std::string& quantity = "UNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC",
                         const std::string& peak = "-1005.350") {
  return "099MAD010203040501\n0010203040506 2001-02-03 04:05:06 BTM\nMADE-UP EARTHQUAKE, NOWHERE,CHN\n"
         "EPICENTER  39.939N 77.339E DEPTH 9 KM\nMAGNITUDE  4.0(Ms)\nSTATION: 99MAD 39.299N 77.800E\n"
         "SITE CONDITION: SOIL\nINSTRUMENT TYPE: ETNA/ES-T\nOBSERVING POINT: GROUND\nCOMP. EW\n" +
         quantity + "\nNO. OF POINTS:  10  EQUALLY SPACED INTERVALS OF:  0.005  SEC\nPEAK VALUE:    " + peak +
         "   AT   0.01 SEC    DURATION:  0.05 SEC\n"
         "PRE-EVENT TIME:  20  SEC  RECORDER TIME:  2001-02-03 04:05:00.000 BTM\nCSMNC\n\n"
         "-1.151609E-2  5.210162E-2 -1.005350E+3 -2.894372E-4 -2.929163E-2 -4.967210E-3  3.947163E-2 -3.096101E-3 \n"
         " 3.526163E-2  9.806650E+0 \n";
}

/// Corrected acceleration of China, and the velocity of the same record behind it.
inline std::string csmnc_corrected() {
  return csmnc("CORRECTED ACCELERATION            UNIT: CM/SEC/SEC") +
         "CORRECTED VELOCITY                UNIT: CM/SEC\n"
         "NO. OF POINTS:  2  EQUALLY SPACED INTERVALS OF:  0.005  SEC\n"
         "PEAK VALUE:    2.000   AT   0.005 SEC    DURATION:  0.01 SEC\n 1.000000E+0  2.000000E+0 \n";
}

/// As the SIGMA project writes it: columns whose signs run together.
inline std::string sigma(const std::string& orientation = "NS", int count = 7) {
  return "Event Date & Time             : 2001-02-03 04:05:06\nStation Code / Name           : 9999 / Made-up, Italy\n"
         "Network                       : MU (Made-up Network)\nOrientation                   : " +
         orientation +
         "\nProcessing Info               : Acausal Butterworth bandpass filtering (4pole-4pole).\n"
         "Filter Cut-off Frequency (Hz) : 0.050 - 25.000\nTime Increment (s)            : 0.005\n"
         "Number of Data                : " +
         std::to_string(count) +
         "\nPGA (m/s/s)                   : 9.8066500E-01\nAccelaration time series in m/s/s\n"
         " 1.2448884E-04 1.2443851E-04-8.4216200E-06-9.8066500E-01 1.8461960E-06\n-6.4590450E-06 2.5000000E-01\n";
}

/// As SCEC's platform converts it: tabs between columns, and a comment that describes each.
inline std::string bbp(const std::string& quantity = "acceleration (cm/s^2)") {
  return "# Station: MU_MADE\n#    time= 02/03/01,04:05:06.00 UTC\n#     lon= -118.0\n#     lat= 34.0\n#   units= "
         "cm/s^2\n"
         "#\n# Data fields are TAB-separated\n# Column 1: Time (s)\n# Column 2: N/S component ground " +
         quantity + " (+ is 000)\n# Column 3: E/W component ground " + quantity +
         " (+ is 090)\n# Column 4: U/D component ground " + quantity +
         " (+ is upward)\n#\n"
         "0.000000e+00\t1.5\t-2.5\t3e-1\n1.250000e-02\t-98.0665\t0\t0\n2.500000e-02\t4\t5\t6\n3.750000e-02\t7\t8\t9\n";
}

/// Integers in columns of five characters and reals in columns of ten, of CSMIP and its ancestors; integer 28 is a count.
inline std::string fixed_header(int count, int reals) {
  std::string text;
  for (int i = 1; i <= 100; ++i)
    text += print("%5.0f", i == 28   ? count
                           : i == 27 ? 360
                           : i == 64 ? 13200
                                     : 0) +
            (i % 16 == 0 || i == 100 ? "\n" : "");
  return text + csmip_numbers(reals, 8, 10, 3);
}

/// CSMIP since 1990: a sampling rate, full integers that run together, several channels.
inline std::string csmip_since_1990(const std::string& orientation = "360 Deg", int count = 12000) {
  std::string text =
      "Uncorrected Accelerogram Data             Processed: 02/13/12, CGS  146be002\n"
      "Record of Mon Feb 13, 2012 13:06:45.0 PST             (Avol1 v9.2,12/11 CSMIP)\nPreliminary\n"
      "89999-L2500-12044.02                 Start time:  2/13/12, 21:06:45.0 UTC (GPS)\nStation No. 89999\n"
      "Made-up Creek                             CGS\nChan  1: " +
      orientation + "\nLine 8\nLine 9\nLine 10\nNo. of Points =  " + std::to_string(count) +
      "  Record Length = 60.000 sec   at 200 Samples/sec\n"
      "Units of uncor data are sec and g .        Max  =   .079 g , at  30.590 sec.\nRMS\n" +
      fixed_header(count, 50) + " " + std::to_string(count) +
      " Accelerogram points at 200 pts/sec in units of g .      Format: (8f9.6)\n";
  for (int i = 0; i < count; ++i)
    text += print("%9.6f", i == 100 ? -.079181 : 1e-6 * (i % 50)) + (i % 8 == 7 ? "\n" : "");
  return text + "/&  ----------  End of data for channel  1 ----------\n";
}

/// Volume I of USC and Caltech: pairs of seconds and tenths of g in columns of seven characters.
inline std::string usc_volume_1() {
  std::string text =
      "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:\nMADE-UP EARTHQUAKE                     21\n"
      "JAN 17, 2001 -1230 GMT\nIBB123  94.570.0 N                     18\nSTATION USC# 0099\n"
      "1 MADE-UP RD., MADE-UP CITY, CA        44\nCOMP N08W\nMADE-UP EARTHQUAKE\nEPICENTER\nINSTR PERIOD\n"
      "NO. OF POINTS =    200      DURATION =    .796 SEC\nUNITS ARE SEC AND G/10\nRMS\n" +
      fixed_header(200, 50);
  for (int i = 0; i < 200; ++i)
    text += print("%7.3f", 0.004 * i) + print("%7.3f", i == 50 ? -4.064 : 0.01 * (i % 9)) + (i % 5 == 4 ? "\n" : "");
  return text;
}

/// Volume II: acceleration, velocity and displacement, the unit above them or only at the peak.
inline std::string usc_volume_2(const std::string& units = "  IN UNITS CM/SEC/SEC") {
  std::string text =
      "CORRECTED ACCELEROGRAM  IIBB127  94.610.0 COMP N08W   FILE   0  CORRESPONDING T\n"
      "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:\nMADE-UP EARTHQUAKE\nJAN 17, 2001\n"
      "IBB127  94.610.0 N                    18\nSTATION USC# 0061\nMADE-UP STATION, CA                  48\n"
      "COMP N08W                             9\n";
  for (int i = 9; i <= 16; ++i) text += "LINE " + std::to_string(i) + "\n";
  text +=
      "AT EQUALLY-SPACED INTERVALS OF    .020  SEC.\n"
      "PEAK ACCELERATION =  -242.39450  CMS/SEC/SEC AT    4.580   SEC.\n";
  for (int i = 19; i <= 25; ++i) text += "LINE " + std::to_string(i) + "\n";
  text += fixed_header(1887, 100);
  for (const char* kind : {"ACC", "VEL", "DIS"}) {
    text += std::string("  16 POINTS OF ") + kind + " DATA EQUALLY SPACED AT   .020 SEC." + units + "\n";
    for (int i = 0; i < 16; ++i) text += print("%10.3f", i == 5 ? -242.395 : i) + (i % 8 == 7 ? "\n" : "");
  }
  return text;
}

/// Volume 1 of BHRC: a component; the lines of its header are cut at 70 characters.
inline std::string bhrc(const std::string& component = "L1", int count = 20) {
  std::string text =
      "* VOL1DS FILE:  9999/01\nInst Type = SSA-2\nOrigin Time : 2012/08/11   12:23:16\n\n" + component.substr(0, 1) +
      "\n \nCOMP " + component +
      "\nMade-up                   Station   37.734 N 47.801 E   Altitude 2026m   Azimuth L 50    T 140\n"
      "Epicenter 38.520 N 46.860 E\nINSTR PERIOD =  .020 SEC\nNO. OF POINTS =   " +
      std::to_string(count) + "      DURATION =   " + print("%.3f", 0.005 * count) +
      "\nUNITS ARE SECONDS AND G/10\n \n";
  std::string integers, reals;
  for (int i = 1; i <= 100; ++i) {
    if (i % 16 == 1) integers.clear();
    integers += print("%5.0f", i == 28 ? count : 0);
    if (i % 16 == 0 || i == 100) text += integers.substr(0, 70) + "\n";
  }
  for (int i = 1; i <= 50; ++i) {
    if (i % 8 == 1) reals.clear();
    reals += i == 9 ? "  .200000E+03" : "  .000000E+00";
    if (i % 8 == 0 || i == 50) text += reals.substr(0, 70) + "\n";
  }
  for (int i = 0; i < count; ++i) text += i == 7 ? " -.244355E+00" : "  .921041E-02", text += i % 10 == 9 ? "\n" : "";
  return text + "/&\n";
}

/// The three series of the USGS of 1987.
inline std::string usgs() {
  std::string text;
  for (const char* type : {"AC", "VL", "DP"}) {
    text += std::string(
                " MADE-UP CITY, 1 MADE-UP AVE\n 090 DEGREES\n EARTHQUAKE OF OCTOBER 1, 1987\n BUTTERWORTH\n"
                " YEAR=1987 JULIAN DAY=274\n SAMPLES/SEC=200 FILTER TYPE=BUTTERWORTH DATA TYPE=") +
            type + "\n NO OF POINTS=    13, UNITS=CM/SEC**2, CM/SEC, AND CM\n";
    for (int i = 0; i < 13; ++i) text += print("%8.2f", i == 4 ? -514.03 : i) + (i % 10 == 9 || i == 12 ? "\n" : "");
  }
  return text;
}

}  // namespace record_files
